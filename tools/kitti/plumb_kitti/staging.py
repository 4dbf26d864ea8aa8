"""Puts drives into folders of links, in a layout that plumb-kitti2lcm and plumb-eval read.

Numbers are copied and never changed. A tracking sequence becomes a raw drive, whose truth comes from oxts.
"""
import datetime
import os
import pathlib
import shutil
import struct
import tomllib

from plumb_kitti import tracklets
from plumb_kitti.discover import RAW_CALIBRATION
from plumb_tools.command_line import UsageError, did_you_mean

TRACKING_PERIOD_US = 100000  # the tracking set has no time stamps; its images were taken at 10 Hz
TRACKING_NAMES = {'R_rect': 'R0_rect', 'Tr_velo_cam': 'Tr_velo_to_cam', 'Tr_imu_velo': 'Tr_imu_to_velo'}


def link(source, target):
    """A link at `target`, when there is a source."""
    if source:
        target.parent.mkdir(parents=True, exist_ok=True)
        target.symlink_to(pathlib.Path(source).resolve())


def read_tracking_calibration(path):
    """{name: numbers as text}. The official files write some names without a colon, or shorter."""
    values = {}
    for line in pathlib.Path(path).read_text().splitlines():
        words = line.replace(':', ' ').split()
        if words:
            values[TRACKING_NAMES.get(words[0], words[0])] = words[1:]
    return values


def png_size(path):
    """(width, height) in pixels out of a PNG's head."""
    with open(path, 'rb') as file:
        head = file.read(24)
    if len(head) < 24 or head[1:4] != b'PNG':
        raise UsageError(f'{path} is not a PNG')
    return struct.unpack('>II', head[16:24])


def rigid_text(numbers):
    """Twelve numbers of [R t] as the lines R and T of a raw calibration file."""
    rows = [numbers[4 * i:4 * i + 4] for i in range(3)]
    return 'R: ' + ' '.join(word for r in rows for word in r[:3]) + '\nT: ' + ' '.join(r[3] for r in rows) + '\n'


def stage_odometry(drive, folder):
    link(drive['images'], folder / f"image_{drive['camera']}")
    for name in ('calib', 'times', 'poses'):
        link(drive[name], folder / f'{name}.txt')
    link(drive['velodyne'], folder / 'velodyne')
    link(drive['planes'], folder / 'gt_ground_plane.txt')


def stage_raw(drive, folder):
    camera = f"image_{drive['camera']:02d}"
    link(drive['images'], folder / camera / 'data')
    link(drive['times'], folder / camera / 'timestamps.txt')
    link(drive['oxts'], folder / 'oxts' / 'data')
    link(drive['velodyne'], folder / 'velodyne_points' / 'data')
    link(drive['poses'], folder / 'poses.txt')
    link(drive['planes'], folder / 'gt_ground_plane.txt')
    for name in RAW_CALIBRATION:
        path = pathlib.Path(drive['calib']).parent / name
        link(path if path.exists() else '', folder / name)


def stage_tracking(drive, folder):
    images = sorted(name for name in os.listdir(drive['images']) if name.endswith('.png'))
    link(drive['images'], folder / 'image_02' / 'data')
    link(drive['velodyne'], folder / 'velodyne_points' / 'data')
    begin = datetime.datetime(2012, 1, 1)
    last = int(images[-1].partition('.')[0])
    stamps = [begin + datetime.timedelta(microseconds=TRACKING_PERIOD_US * k) for k in range(last + 1)]
    kept = stamps if len(images) == last + 1 else [stamps[int(name.partition('.')[0])] for name in images]
    (folder / 'image_02/timestamps.txt').write_text(''.join(f'{stamp:%Y-%m-%d %H:%M:%S.%f}000\n' for stamp in kept))
    values = read_tracking_calibration(drive['calib'])
    width, height = png_size(pathlib.Path(drive['images']) / images[0])
    cam = f"S_rect_02: {width} {height}\nR_rect_00: {' '.join(values['R0_rect'])}\n"
    cam += ''.join(f"P_rect_0{k}: {' '.join(values[f'P{k}'])}\n" for k in range(4) if f'P{k}' in values)
    (folder / RAW_CALIBRATION[0]).write_text(cam)
    for name, key in zip(RAW_CALIBRATION[1:], ('Tr_velo_to_cam', 'Tr_imu_to_velo')):
        if key in values:
            (folder / name).write_text(rigid_text(values[key]))
    if drive['oxts']:
        data = folder / 'oxts/data'
        data.mkdir(parents=True)
        for k, line in enumerate(pathlib.Path(drive['oxts']).read_text().splitlines()):
            (data / f'{k:010d}.txt').write_text(line + '\n')


def write_projections(folder):
    """The calib.txt of the odometry set, which plumb-eval placed reads, out of a raw drive's file."""
    values = read_tracking_calibration(folder / RAW_CALIBRATION[0])
    lines = [f"P{k}: {' '.join(values[f'P_rect_0{k}'])}\n" for k in range(4) if f'P_rect_0{k}' in values]
    (folder / 'calib.txt').write_text(''.join(lines))


def stage_folder(drive, folder):
    link(drive['images'], folder / 'images')
    link(drive['calib'], folder / 'camera.toml')
    link(drive['times'], folder / 'times.txt')


def read_toml(path):
    try:
        return tomllib.loads(pathlib.Path(path).read_text())
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise UsageError(f'{path}: {error}') from None


MAP_KEYS = {'length_m': (0.1, 1e6), 'end_distance_m': (0.0, 1e6), 'rate_hz': (0.1, 1000.0)}


def read_map(path):
    """{'length_m', 'end_distance_m', 'rate_hz'} of a map.toml; what it does not state is a loop at 10 images per second."""
    values = {'end_distance_m': 0.0, 'rate_hz': 10.0, **read_toml(path)}
    for key, value in values.items():
        if key not in MAP_KEYS:
            raise UsageError(f'{path}: unknown key {key}' + did_you_mean(key, MAP_KEYS))
        low, high = MAP_KEYS[key]
        if not isinstance(value, (int, float)) or not low <= value <= high:
            raise UsageError(f'{path}: {key} = {value} is not a number in [{low:g}, {high:g}]')
    if 'length_m' not in values:
        raise UsageError(f'{path}: length_m is missing')
    return values


def stage_labels(drive, folder):
    """Leaves label_02.txt, made of a raw drive's tracklets where the drive has no labels."""
    if drive['labels'] or not drive['tracklets']:
        link(drive['labels'], folder / 'label_02.txt')
        return
    cam, velo = (read_tracking_calibration(folder / name) if (folder / name).exists() else {}
                 for name in RAW_CALIBRATION[:2])
    if 'S_rect_02' not in cam or not velo:
        raise UsageError(f"{drive['tracklets']}: no calib_velo_to_cam.txt, or no S_rect_02 in calib_cam_to_cam.txt beside it")
    (folder / 'label_02.txt').write_text(tracklets.labels(drive['tracklets'], cam, velo))


STAGERS = {'odometry': stage_odometry, 'raw': stage_raw, 'tracking': stage_tracking, 'folder': stage_folder}


def stage(drive, folder, with_labels=False):
    """Makes the folder anew. With labels it also has label_02.txt and the boxes of trackers."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    STAGERS[drive['kind']](drive, folder)
    if with_labels:
        if not (folder / 'calib.txt').exists():
            write_projections(folder)
        stage_labels(drive, folder)
        link(drive['candidates'], folder / 'candidates.txt')
        for name, path in drive['boxes'].items():
            link(path, folder / f'{name}.txt')


def stage_label_folder(source, folder, boxes):
    """A tracking folder of calibration and labels alone, for plumb-eval objects."""
    shutil.rmtree(folder, ignore_errors=True)
    (folder / 'calib').mkdir(parents=True)
    for path in sorted((pathlib.Path(source) / 'calib').glob('*.txt')):
        lines = [f"{name}: {' '.join(words)}\n" for name, words in read_tracking_calibration(path).items()]
        (folder / 'calib' / path.name).write_text(''.join(lines))
    link(pathlib.Path(source) / 'label_02', folder / 'label_02')
    for name, path in boxes.items():
        link(path, folder / 'boxes' / name)
