"""Finds drives below a folder: KITTI's odometry set, tracking set and raw drives, and plain folders with a map."""
import dataclasses
import os
import pathlib
import re

from plumb_tools.command_line import UsageError

MAX_DEPTH = 6
SKIPPED = {'velodyne', 'velodyne_points', 'oxts', 'det2d', 'label_02', 'calib', 'candidates'}
IMAGE_ENDS = ('.png', '.jpg', '.jpeg', '.pgm', '.bmp')
RAW_CALIBRATION = ('calib_cam_to_cam.txt', 'calib_velo_to_cam.txt', 'calib_imu_to_velo.txt')


@dataclasses.dataclass
class Drive:
    """One drive. Paths are texts, '' where there is no such file."""
    name: str
    kind: str            # odometry, tracking, raw or folder
    folder: str          # of the sequence; of training or testing for the tracking set
    number: str          # '04', '0000', '2011_09_26_drive_0009_sync'
    camera: int          # 0 left grey .. 3 right colour
    images: str
    num_images: int
    calib: str = ''
    times: str = ''
    poses: str = ''
    oxts: str = ''
    velodyne: str = ''
    road_labels: str = ''
    planes: str = ''
    labels: str = ''
    tracklets: str = ''
    candidates: str = ''  # a detector's boxes before suppression
    map: str = ''         # map.toml: the length of the road, and how far its end is from its beginning
    boxes: dict = dataclasses.field(default_factory=dict)
    lacks: list = dataclasses.field(default_factory=list)

    @property
    def has_truth(self):
        return bool(self.poses or self.oxts)

    @property
    def for_server(self):
        """Whether the benchmark's server wants this drive: sequences 11 to 21."""
        return self.kind == 'odometry' and self.number in {f'{n:02d}' for n in range(11, 22)}


def count_images(folder):
    return sum(entry.name.endswith(IMAGE_ENDS) for entry in os.scandir(folder))


def first_of(*paths):
    """The first path that exists, as text, or ''."""
    return next((str(path) for path in paths if path.exists()), '')


def image_folder(folder, pattern, tail=''):
    """(camera, folder of its images) of the first camera that is there: grey before colour, left
    before right; or None."""
    for camera in (0, 2, 1, 3):
        path = folder / (pattern % camera) / tail
        if path.is_dir() and count_images(path):
            return camera, path
    return None


def planes_of(folder):
    return next((str(path) for path in sorted(folder.glob('gt_ground_plane*.txt'))), '')


def own_boxes(folder, name):
    """{tracker: file} of folder/det2d/TRACKER/NAME.txt, or of folder/det2d/TRACKER.txt."""
    found = {path.parent.name: str(path) for path in sorted(folder.glob(f'det2d/*/{name}.txt'))}
    found.update({path.stem: str(path) for path in sorted(folder.glob('det2d/*.txt'))})
    return found


def candidates_of(folder, name):
    return first_of(folder / 'candidates' / f'{name}.txt', folder / 'candidates.txt')


def odometry_drive(folder, root):
    """A folder with image_0 (or _1 .. _3) in it, as the odometry set has them."""
    camera, images = image_folder(folder, 'image_%d')
    name = folder.name
    above = [folder.parent.parent, folder.parent, root]
    drive = Drive(name, 'odometry', str(folder), name, camera, str(images), count_images(images),
                  calib=first_of(folder / 'calib.txt', *(top / 'calib' / f'{name}.txt' for top in above)),
                  times=first_of(folder / 'times.txt', *(top / 'times' / f'{name}.txt' for top in above)),
                  poses=first_of(folder / 'poses.txt', *(top / 'poses' / f'{name}.txt' for top in above)),
                  velodyne=first_of(folder / 'velodyne'), road_labels=first_of(folder / 'labels'),
                  planes=planes_of(folder), labels=first_of(folder / 'label_02.txt'), boxes=own_boxes(folder, name),
                  candidates=candidates_of(folder, name))
    for what, zip_name in (('calib', 'data_odometry_calib.zip'), ('times', 'data_odometry_calib.zip')):
        if not getattr(drive, what):
            drive.lacks.append(f'{what} ({zip_name})')
    return drive


def raw_drive(folder):
    """A folder with image_00/data (or image_02/data) in it."""
    camera, images = image_folder(folder, 'image_%02d', 'data')
    number = folder.name
    drive = Drive(re.sub(r'_(sync|extract)$', '', number), 'raw', str(folder), number, camera, str(images),
                  count_images(images),
                  calib=first_of(*(top / RAW_CALIBRATION[0] for top in (folder, folder.parent))),
                  times=first_of(folder / f'image_{camera:02d}' / 'timestamps.txt'),
                  poses=first_of(folder / 'poses.txt'), oxts=first_of(folder / 'oxts' / 'data'),
                  velodyne=first_of(folder / 'velodyne_points' / 'data'), planes=planes_of(folder),
                  labels=first_of(folder / 'label_02.txt'), boxes=own_boxes(folder, number),
                  candidates=candidates_of(folder, number), tracklets=first_of(folder / 'tracklet_labels.xml'))
    date = '_'.join(number.split('_')[:3])
    if not drive.calib:
        drive.lacks.append(f'calib_cam_to_cam.txt ({date}_calib.zip)')
    if not drive.times:
        drive.lacks.append(f'timestamps.txt ({number}.zip)')
    return drive


def tracking_drives(folder):
    """The sequences of training or testing that have images."""
    found = []
    prefix = 'tracking_' if folder.name == 'training' else f'tracking_{folder.name}_'
    for images in sorted((folder / 'image_02').glob('[0-9][0-9][0-9][0-9]')):
        number = images.name
        if not images.is_dir() or not count_images(images):
            continue
        drive = Drive(prefix + number, 'tracking', str(folder), number, 2, str(images), count_images(images),
                      calib=first_of(folder / 'calib' / f'{number}.txt'),
                      oxts=first_of(folder / 'oxts' / f'{number}.txt'),
                      velodyne=first_of(folder / 'velodyne' / number),
                      labels=first_of(folder / 'label_02' / f'{number}.txt'), boxes=own_boxes(folder, number),
                      candidates=candidates_of(folder, number))
        if not drive.calib:
            drive.lacks.append('calib (data_tracking_calib.zip)')
        found.append(drive)
    return found


def plain_drive(folder):
    """A folder with images (in it, or in its folder images), map.toml and camera.toml, as The Hague's sequences would be."""
    images = folder / 'images' if (folder / 'images').is_dir() else folder
    drive = Drive(folder.name, 'folder', str(folder), folder.name, 0, str(images), count_images(images),
                  calib=first_of(folder / 'camera.toml'), times=first_of(folder / 'times.txt'), map=str(folder / 'map.toml'))
    if not drive.calib:
        drive.lacks.append('camera.toml (docs/add_a_camera.md)')
    if not drive.num_images:
        drive.lacks.append('images (from the authors of the data set)')
    return drive


def is_tracking(folder, names):
    return 'image_02' in names and any((folder / 'image_02').glob('[0-9][0-9][0-9][0-9]'))


def find(root):
    """(drives sorted by name, folders of tracking labels) below `root`. Raises UsageError."""
    drives, label_folders = [], []
    for path, names, _ in os.walk(root, followlinks=True):
        folder = pathlib.Path(path)
        names[:] = sorted(names)
        if {'calib', 'label_02'} <= set(names):
            label_folders.append(folder)
        if is_tracking(folder, names):
            drives += tracking_drives(folder)
            names.clear()
        elif image_folder(folder, 'image_%d'):
            drives.append(odometry_drive(folder, pathlib.Path(root)))
            names.clear()
        elif image_folder(folder, 'image_%02d', 'data'):
            drives.append(raw_drive(folder))
            names.clear()
        elif (folder / 'map.toml').exists():
            drives.append(plain_drive(folder))
            names.clear()
        names[:] = [name for name in names if name not in SKIPPED]
        if len(folder.relative_to(root).parts) >= MAX_DEPTH:
            names.clear()
    if not drives and not label_folders:
        raise UsageError(f'{root} holds no KITTI data: neither sequences/NN/image_0, nor training/image_02/NNNN or '
                         'training/label_02, nor a raw drive with image_00/data, nor a folder of images with '
                         'map.toml')
    names = [drive.name for drive in drives]
    for name in names:
        if names.count(name) > 1:
            raise UsageError('two drives are named ' + name + ': ' +
                             ' and '.join(drive.folder for drive in drives if drive.name == name))
    return sorted(drives, key=lambda drive: drive.name), sorted(label_folders)
