"""What a job's results depend on beside files of other jobs: programs, settings, trials and source data.

Each is a small file in OUT/keys, rewritten only when its text changes. The workflow compares times of files, so a job
whose program, settings or data changed runs again, and no other one does.
"""
import hashlib
import json
import os
import pathlib

from plumb_kitti import plan as plans

HERE = pathlib.Path(__file__).resolve().parent
# The modules whose code decides what a job does; those of the page are not among them, since it is always made anew.
STEPS = ('jobs.py', 'staging.py', 'tracklets.py', 'training_jobs.py')
FILES = ('calib', 'times', 'poses', 'planes', 'labels', 'tracklets', 'candidates', 'map')
FOLDERS = ('images', 'oxts', 'velodyne', 'road_labels')


def digest(path):
    with open(path, 'rb') as file:
        return hashlib.file_digest(file, 'sha256').hexdigest()


def state_of_folder(path):
    """(number of files, newest time) in a folder of the data set, or of a single file."""
    if not os.path.isdir(path):
        return [1, os.stat(path).st_mtime_ns]
    times = [entry.stat().st_mtime_ns for entry in os.scandir(path)]
    return [len(times), max(times, default=0)]


def state_of_drive(drive):
    """What is known of a drive, and what its files hold: of the large ones, number and newest time alone."""
    files = {key: digest(drive[key]) for key in FILES if drive.get(key)}
    boxes = {name: digest(path) for name, path in drive['boxes'].items()}
    folders = {key: state_of_folder(drive[key]) for key in FOLDERS if drive.get(key)}
    return {'drive': drive, 'files': files, 'boxes': boxes, 'folders': folders}


def texts(plan, programs):
    """{name of the key: its text}."""
    found = {f'program/{name}': digest(pathlib.Path(plan['bin']) / name) for name in programs}
    found['steps'] = ' '.join(digest(HERE / name) for name in STEPS)
    found.update({f'mode/{mode}': plans.MODES[mode] for mode in {*plan['modes'], 'default', 'paper'}})
    found.update({f'plane/{plane}': plans.PLANES[plane] for plane in plan['planes']})
    for name, drive in plan['drives'].items():
        found[f'drive/{name}'] = json.dumps(state_of_drive(drive), indent=1, sort_keys=True)
        found.update({f'trial/{name}/{k}': json.dumps(trial, sort_keys=True)
                      for k, trial in enumerate(plan['trials'][name])})
    for number, folder in plan['label_folders'].items():
        sources = [f'{folder}/calib', f'{folder}/label_02', *plan['trackers'][number].values()]
        found[f'labels/{number}'] = json.dumps([[path, *state_of_folder(path)] for path in sources])
    for system, files in plan['others'].items():
        found.update({f'other/{system}/{drive}': digest(path) for drive, path in files.items()})
    found['detector'] = digest(plan['detector']) if plan['detector'] else ''
    return found


def write(plan, programs, out):
    """Brings OUT/keys up to date."""
    for name, text in texts(plan, programs).items():
        path = out / 'keys' / name
        if path.exists() and path.read_text() == text:
            continue
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
