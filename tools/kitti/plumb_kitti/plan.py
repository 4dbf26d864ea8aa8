"""What to run: drives, modes, trials and the jobs that follow from them, as one plain dictionary.

plan.json is rewritten only when it changes, because the workflow compares times of files.
"""
import hashlib
import json
import pathlib
import random

from plumb_kitti import staging
from plumb_tools.accuracy.bench import MODES

# The planes of Fig. 12: calibrated, dense alone, fixed and adaptive fusion; and the default.
PLANES = {'calibrated': '[objects]\nplane = "calibrated"\n', 'paper-dense': MODES['paper-dense'],
          'paper-fixed': MODES['paper-fixed'], 'paper': MODES['paper'], 'default': ''}
NOMINAL_HEIGHT_M = 1.65
PROJECTIONS = ('P%d', 'P_rect_%02d')


def is_paper(mode):
    return mode.startswith('paper')


def camera_facts_of_file(path):
    """The same for a plain folder's camera.toml."""
    camera = staging.read_toml(path).get('camera', {})
    facts = {'height_m': camera.get('camera_height_m', NOMINAL_HEIGHT_M), **{key: camera.get(key) for key in
                                                                              ('fx_px', 'cx_px', 'cy_px')}}
    return facts, hashlib.sha256(repr(sorted(camera.items())).encode()).hexdigest()[:8]


def camera_facts(drive):
    """The camera as calib states it: the line of its projection, and its height above the road."""
    if drive['kind'] == 'folder':
        return camera_facts_of_file(drive['calib'])
    values = staging.read_tracking_calibration(drive['calib'])
    names = [pattern % drive['camera'] for pattern in PROJECTIONS]
    projection = next((values[name] for name in names if name in values), [])
    height = float(values['camera_height_m'][0]) if 'camera_height_m' in values else NOMINAL_HEIGHT_M
    numbers = [float(word) for word in projection]
    facts = {'height_m': height, 'fx_px': numbers[0] if numbers else None, 'cx_px': numbers[2] if numbers else None,
             'cy_px': numbers[6] if numbers else None}
    rig = hashlib.sha256(repr((drive['kind'] == 'raw', projection, height)).encode()).hexdigest()[:8]
    return facts, rig


def trial_of(number, num_images):
    """How trial `number` differs from the recording; trial 0 is the recording itself."""
    if number == 0:
        return {'skip': 0, 'noise': 0.0, 'drop': 0.0, 'seed': 1}
    draw = random.Random(number)
    return {'skip': draw.randrange(1, max(2, min(30, num_images // 5))), 'noise': round(draw.uniform(0.5, 3.0), 2),
            'drop': round(draw.uniform(0.0, 0.03), 3), 'seed': number + 1}


def make(drives, label_folders, options, trackers, others):
    """The plan. `drives` are plain dictionaries that lack nothing."""
    facts = {}
    for drive in drives:
        facts[drive['name']], drive['rig'] = camera_facts(drive)
        drive['camera_facts'] = facts[drive['name']]
    trials = {drive['name']: [trial_of(k, drive['num_images']) for k in range(options.trials + 1)] for drive in drives}
    boxes = {drive['name']: ['label_02', *sorted(drive['boxes'])] for drive in drives
             if drive['labels'] or drive['tracklets']}
    by_name = {drive['name']: drive for drive in drives}
    true = [drive['name'] for drive in drives if drive['poses'] or drive['oxts']]
    seen = [name for name in true if name in boxes and (options.detector or by_name[name]['candidates'])]
    return {'bin': str(pathlib.Path(options.bin).resolve()), 'drives': by_name,
            'modes': sorted({'default', *options.modes}, key=list(MODES).index), 'trials': trials, 'boxes': boxes,
            'planes': list(PLANES), 'label_folders': {str(k): path for k, path in enumerate(label_folders)},
            'trackers': trackers, 'others': others,
            'detector': str(options.detector.resolve()) if options.detector else '', 'example': (seen or true)[:1]}


def write(plan, path):
    text = json.dumps(plan, indent=1, sort_keys=True) + '\n'
    if not path.exists() or path.read_text() != text:
        path.write_text(text)


def read(out):
    return json.loads((pathlib.Path(out) / 'plan.json').read_text())
