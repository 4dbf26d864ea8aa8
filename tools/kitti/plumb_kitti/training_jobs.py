"""The jobs of Algorithm 1: candidates of a detector, samples, one image as an example, and the fit."""
import json
import shutil

from plumb_kitti import plan as plans
from plumb_kitti import staging
from plumb_tools.command_line import UsageError

NO_BOXES = 'seq,objects_confidence,objects_error,distance_m\n'
LAST_TRAINING = 8  # of the tracking set, as in the paper; the sequences after it are for the test


def is_for_test(drive):
    return drive['kind'] == 'tracking' and int(drive['number']) > LAST_TRAINING


def candidates_of(job, name):
    """The drive's file of boxes from before suppression, or None."""
    made = job.out / 'candidates' / f'{name}.txt'
    return made if made.exists() else job.drive(name)['candidates'] or None


def candidates(job, name):
    """Runs the user's detector over a drive."""
    folder = job.out / 'candidates'
    folder.mkdir(exist_ok=True)
    part = folder / f'{name}.part'
    job.programs.run('plumb-boxes', job.out / 'logs' / f'{name}.lcm', '--config', job.plan['detector'], '--out',
                     folder / f'{name}.boxes.txt', '--candidates', part)
    part.replace(folder / f'{name}.txt')


def log_with_boxes(job, name, folder):
    """Leaves a log of the drive with boxes and their candidates in the folder: the detector's own, else the labels'."""
    drive, staged, log = job.drive(name), folder / 'drive', folder / 'boxes.lcm'
    staging.stage(drive, staged, with_labels=True)
    own = job.out / 'candidates' / f'{name}.boxes.txt'
    boxes = own if own.exists() else staged / 'label_02.txt'
    planes = job.out / 'planes' / f'{name}.txt'
    with_planes = ['--planes', planes] if planes.exists() and not drive['planes'] else []
    job.programs.run('plumb-kitti2lcm', staged, '--camera', drive['camera'], '--detections', boxes, '--candidates',
                     candidates_of(job, name), *with_planes, '--out', log)
    return log


def settings_of(job, name, folder):
    return job.settings(name, plans.MODES['paper'], True, folder / f'{name}.toml')


def sample(job, name):
    """What the cues of the published method measured beside the truth."""
    folder = job.out / 'fit' / 'samples'
    folder.mkdir(parents=True, exist_ok=True)
    part = folder / f'{name}.part'
    job.programs.run('plumb-train', 'sample', job.out / 'logs' / f'{name}.lcm', '--out', part, '--config',
                     settings_of(job, name, folder), '--drive', name, '--again')
    part.replace(folder / f'{name}.csv')


def boxes(job, name):
    """What the objects of a drive measured beside the true planes; a file without rows where there are none."""
    folder = job.out / 'fit' / 'boxes'
    work = folder / f'{name}.work'
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    part = folder / f'{name}.part'
    try:
        job.programs.run('plumb-train', 'boxes', log_with_boxes(job, name, work), '--out', part, '--config',
                         settings_of(job, name, folder))
    except UsageError as error:
        if 'no detected object has a true plane' not in str(error):
            raise
        part.write_text(NO_BOXES)
    shutil.rmtree(work)
    part.replace(folder / f'{name}.csv')


def example(job, name):
    """Figs 3 and 7: what the confidences of one image are fitted to."""
    folder = job.out / 'fit' / 'example.work'
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    log = log_with_boxes(job, name, folder) if candidates_of(job, name) else job.out / 'logs' / f'{name}.lcm'
    part = job.out / 'fit' / 'example.part'
    job.programs.run('plumb-train', 'example', log, '--config', settings_of(job, name, folder), '--json', part)
    result = json.loads(part.read_text())
    part.write_text(json.dumps({'drive': name, **result}) + '\n')
    shutil.rmtree(folder)
    part.replace(job.out / 'fit' / 'example.json')


def fit(job):
    """Fits the published method's lines to the samples; objects of the tracking set's test sequences take no part."""
    folder = job.out / 'fit'
    part = folder / 'fit.part.json'
    objects = [path for path in sorted((folder / 'boxes').glob('*.csv')) if path.read_text() != NO_BOXES and
               path.stem in job.plan['drives'] and not is_for_test(job.drive(path.stem))]
    job.programs.run('plumb-train', 'fit', *sorted((folder / 'samples').glob('*.csv')),
                     *(word for path in objects for word in ('--boxes', path)), '--out', folder / 'model.toml', '--json', part,
                     log=folder / 'fit.txt')
    part.replace(folder / 'fit.json')
