"""The jobs of the workflow. Each leaves its files below the folder of results, the last one whole."""
import json
import math
import pathlib
import shutil
import statistics
import sys
import zipfile

from plumb_kitti import plan as plans
from plumb_kitti import staging, training_jobs
from plumb_tools.command_line import UsageError
from plumb_tools.drive_files import positions, read_frames, read_poses
from plumb_tools.programs import Programs

LENGTHS = {'short': '10,20,50', 'long': 'new'}


class Job:
    """What the jobs share: the plan, the programs and the folder of results."""

    def __init__(self, out):
        self.out = pathlib.Path(out).absolute()
        self.plan = plans.read(out)
        self.programs = Programs(self.plan['bin'])

    def drive(self, name):
        return self.plan['drives'][name]

    def height(self, name):
        return self.drive(name)['camera_facts']['height_m']

    def settings(self, name, text, is_paper, path):
        """Writes a configuration; the published method also gets the calibrated mount of the rig."""
        if is_paper:
            rig = json.loads((self.out / 'rigs' / f"{self.drive(name)['rig']}.json").read_text())
            text += f"[ground.paper]\npitch_rad = {rig['pitch_rad']}\nroll_rad = {rig['roll_rad']}\n"
        path.write_text(text)
        return path


def write_json(path, value):
    """Writes a result in one step, so that a killed job leaves none or all of it."""
    part = path.with_suffix('.part')
    part.write_text(json.dumps(value, indent=1, sort_keys=True) + '\n')
    part.replace(path)


def fresh_folder(path):
    shutil.rmtree(path, ignore_errors=True)
    path.mkdir(parents=True)
    return path


def find_planes(job, name, staged):
    """Fits planes to the drive's scans; they become its truth where the data set has none."""
    drive, programs = job.drive(name), job.programs
    folder = job.out / 'planes'
    folder.mkdir(exist_ok=True)
    found = folder / f'{name}.txt'
    words = ['--labels', drive['road_labels']] if drive['road_labels'] else []
    if drive['planes']:
        words += ['--against', drive['planes'], '--json', folder / f'{name}.json']
    programs.run('plumb-planes', staged, '--out', found, *words)
    if not drive['planes']:
        (staged / 'gt_ground_plane.txt').symlink_to(found)


def log(job, name):
    """Converts a drive. A folder of scans without a road is no reason to stop."""
    drive = job.drive(name)
    staged = job.out / 'drives' / name
    staging.stage(drive, staged)
    if drive['velodyne']:
        try:
            find_planes(job, name, staged)
        except UsageError as error:
            print(f'job: {name}: {error}', file=sys.stderr)
    (job.out / 'logs').mkdir(exist_ok=True)
    whole = job.out / 'logs' / f'{name}.lcm'
    part, said = whole.with_suffix('.part.lcm'), job.out / 'logs' / f'{name}.txt'
    if drive['kind'] == 'folder':
        rate = ['--times', staged / 'times.txt'] if drive['times'] else ['--rate', staging.read_map(drive['map'])['rate_hz']]
        job.programs.run('plumb-convert', staged / 'images', '--camera', staged / 'camera.toml', *rate, '--out', part, log=said)
    else:
        job.programs.run('plumb-kitti2lcm', staged, '--out', part, '--camera', drive['camera'], log=said)
    part.replace(whole)


def counts_of(frames, column):
    counts = {}
    for frame in frames:
        counts[frame[column] or 'refused'] = counts.get(frame[column] or 'refused', 0) + 1
    return counts


def errors_of(report):
    keys = ('num_segments', 't_percent', 'r_deg_m', 'by_length', 'by_speed')
    return {key: report[key] for key in keys}


def evaluate(job, name, folder, result):
    """Adds what plumb-eval says of a run whose truth stands beside it."""
    programs, truth, planes = job.programs, folder / 'truth.txt', folder / 'planes.txt'
    for kind, lengths in LENGTHS.items():
        programs.run('plumb-eval', truth, folder / 'poses.txt', '--lengths', lengths, '--json', folder / f'{kind}.json',
                     '--samples', folder / f'{kind}.csv')
        report = json.loads((folder / f'{kind}.json').read_text())['sequences'][0]
        result[kind], result['path_m'] = errors_of(report), report['path_m']
    with_planes = ['--planes', planes] if planes.exists() else []
    programs.run('plumb-eval', 'height', truth, folder / 'frames.csv', *with_planes, '--height', job.height(name),
                 '--json', folder / 'height.json', '--samples', folder / 'height.csv', '--drive', name)
    heights = json.loads((folder / 'height.json').read_text())
    result['height'] = {cue: {key: value for key, value in errors.items() if not isinstance(value, list)}
                        for cue, errors in heights.items()}
    if planes.exists() and programs.succeeds('plumb-eval', 'plane', planes, folder / 'frames.csv', '--json',
                                             folder / 'plane.json'):
        result['plane'] = json.loads((folder / 'plane.json').read_text())


def end_point(poses, road):
    """How a path ends against the map: distance of its end from its beginning, error in % of the road's length."""
    places = positions(poses)
    distance_m = math.dist(places[0], places[-1])
    return {'map_length_m': road['length_m'], 'path_m': sum(math.dist(a, b) for a, b in zip(places, places[1:])),
            'end_distance_m': distance_m,
            'error_percent': 100.0 * abs(distance_m - road['end_distance_m']) / road['length_m']}


def run(job, name, mode, number):
    """Replays a drive in a mode, disturbed as the trial says, and measures it."""
    folder = fresh_folder(job.out / 'runs' / name / mode / number)
    trial = job.plan['trials'][name][int(number)]
    config = job.settings(name, plans.MODES[mode], plans.is_paper(mode), folder / 'settings.toml')
    source, disturbed = job.out / 'logs' / f'{name}.lcm', folder / 'trial.lcm'
    disturb = ['--out', disturbed] if int(number) else []
    job.programs.run('plumb-trial', source, *disturb, '--poses', folder / 'truth.txt', '--planes',
                     folder / 'planes.txt', *(word for key, value in trial.items() for word in (f'--{key}', value)))
    job.programs.run('plumb-replay', disturbed if disturb else source, '--config', config, '--seed', trial['seed'],
                     '--poses', folder / 'poses.txt', '--csv', folder / 'frames.csv', '--no-times',
                     log=folder / 'replay.txt')
    disturbed.unlink(missing_ok=True)
    frames = read_frames(folder / 'frames.csv')
    result = {'drive': name, 'mode': mode, 'trial': trial, 'num_frames': len(frames),
              'ego_status': counts_of(frames, 'ego_status')}
    if (folder / 'truth.txt').exists():
        evaluate(job, name, folder, result)
    if job.drive(name)['map']:
        result['end_point'] = end_point(read_poses(folder / 'poses.txt'), staging.read_map(job.drive(name)['map']))
    write_json(folder / 'result.json', result)


def rig(job, name):
    """The mount of a rig without any truth: medians of the default's pitch and roll over its drives."""
    values = {'pitch_rad': [], 'roll_rad': []}
    drives = sorted(drive['name'] for drive in job.plan['drives'].values() if drive['rig'] == name)
    for drive in drives:
        for frame in read_frames(job.out / 'runs' / drive / 'default/0/frames.csv'):
            if frame['plane_status'] == 'ok':
                for key, list_ in values.items():
                    list_.append(float(frame[key]))
    (job.out / 'rigs').mkdir(exist_ok=True)
    mount = {key: round(statistics.median(list_), 6) if list_ else 0.0 for key, list_ in values.items()}
    write_json(job.out / 'rigs' / f'{name}.json', {'drives': drives, 'num_frames': len(values['pitch_rad']), **mount})


def placed(job, name, boxes, plane):
    """Replays a drive with boxes on a plane of Fig. 12, and measures where its objects are placed."""
    drive = job.drive(name)
    folder = fresh_folder(job.out / 'placed' / name / boxes / plane)
    staged = folder / 'drive'
    staging.stage(drive, staged, with_labels=True)
    config = job.settings(name, plans.PLANES[plane], plans.is_paper(plane), folder / 'settings.toml')
    files = [folder / 'frames.csv', folder / 'objects.csv']
    own = training_jobs.candidates_of(job, name)
    candidates = ['--candidates', own] if own else []
    try:
        job.programs.run('plumb-kitti2lcm', staged, '--camera', drive['camera'], '--detections',
                         staged / f'{boxes}.txt', *candidates, '--out', folder / 'boxes.lcm')
        job.programs.run('plumb-replay', folder / 'boxes.lcm', '--config', config, '--csv', files[0], '--objects',
                         files[1], '--no-times', log=folder / 'replay.txt')
        job.programs.run('plumb-eval', 'placed', staged, *files, '--config', config, '--boxes', f'{boxes}.txt', '--json',
                         folder / 'placed.json')
        result = json.loads((folder / 'placed.json').read_text())['all']
    except UsageError as error:  # such as boxes in another format; trying again does not help, so the page says it
        result = {'refused': str(error).replace(f'{staged}/', '').replace(f'{folder}/', '')}
    (folder / 'boxes.lcm').unlink(missing_ok=True)
    write_json(folder / 'result.json', result)


def objects(job, number, boxes):
    """Places the boxes of the tracking set without images."""
    folder = job.out / 'objects' / number
    folder.mkdir(parents=True, exist_ok=True)
    trackers = job.plan['trackers'][number]
    staged = folder / f'set_{boxes}'
    staging.stage_label_folder(job.plan['label_folders'][number], staged, {boxes: trackers.get(boxes, '')})
    words = ['--boxes', f'boxes/{boxes}'] if boxes in trackers else []
    job.programs.run('plumb-eval', 'objects', staged, *words, '--json', folder / f'{boxes}.part.json')
    (folder / f'{boxes}.part.json').replace(folder / f'{boxes}.json')


def other(job, system, name):
    """Measures another system's trajectory like a run."""
    folder = job.out / 'others' / system
    folder.mkdir(parents=True, exist_ok=True)
    result = {'drive': name, 'system': system}
    truth = job.out / 'runs' / name / 'default/0/truth.txt'
    for kind, lengths in LENGTHS.items():
        report = folder / f'{name}.{kind}.part'
        job.programs.run('plumb-eval', truth, job.plan['others'][system][name], '--lengths', lengths, '--json', report)
        result[kind] = errors_of(json.loads(report.read_text())['sequences'][0])
    write_json(folder / f'{name}.json', result)


def server(job):
    """The benchmark server's files: sequences 11 to 21 if they are here, else every drive's."""
    names = [name for name, drive in job.plan['drives'].items()
             if drive['kind'] == 'odometry' and drive['number'].isdigit() and 11 <= int(drive['number']) <= 21]
    results = fresh_folder(job.out / 'results')
    part = job.out / 'results.part'
    with zipfile.ZipFile(part, 'w', zipfile.ZIP_DEFLATED) as archive:
        for name in job.plan['drives']:
            path = results / f'{name}.txt'
            shutil.copyfile(job.out / 'runs' / name / 'default/0/poses.txt', path)
            if name in names:  # with a fixed time, so that the same results give the same file
                archive.writestr(zipfile.ZipInfo(f'{name}.txt'), path.read_bytes(), zipfile.ZIP_DEFLATED)
    part.replace(job.out / 'results.zip')


def main():
    from plumb_kitti import compare, page, report
    known = {function.__name__: function for function in
             (log, run, rig, placed, objects, other, server, training_jobs.candidates, training_jobs.sample,
              training_jobs.boxes, training_jobs.example, training_jobs.fit, compare.compare, page.bundle, report.report)}
    if len(sys.argv) < 3 or sys.argv[2] not in known:
        raise UsageError('want OUT and the name of a job')
    known[sys.argv[2]](Job(sys.argv[1]), *sys.argv[3:])
