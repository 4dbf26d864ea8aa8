"""Turns the tracklet_labels.xml of a raw drive into labels of the tracking set's form.

A tracklet is a box of fixed size with a pose per image in the frame of the Velodyne (x ahead, y left, z up; the
origin is the middle of the box's underside). A label has that in rectified camera 0, and the box in the image of the
left colour camera.
"""
import math
import xml.etree.ElementTree

from plumb_tools.command_line import UsageError

OUT_OF_IMAGE = 2      # and, as 99, behind the camera
LEAST_AHEAD_M = 0.5   # a corner nearer than this, or behind the camera, has no place in the image
LEAST_BOX_PX = 1.0
NAMES = {'Person (sitting)': 'Person_sitting'}


def number(item, name, path):
    """The number in the element `name` of `item`."""
    try:
        return float(item.findtext(name))
    except (TypeError, ValueError):
        raise UsageError(f'{path}: a tracklet has no number {name}') from None


def read(path):
    """[(type, (height, width, length), first image, [(x, y, z, yaw, occlusion, truncation)])], in metres and radians."""
    try:
        root = xml.etree.ElementTree.parse(path).getroot()
    except xml.etree.ElementTree.ParseError as error:
        raise UsageError(f'{path}: {error}') from None
    found = []
    for item in root.findall('tracklets/item'):
        size = tuple(number(item, name, path) for name in 'hwl')
        poses = [tuple(number(pose, name, path) for name in ('tx', 'ty', 'tz', 'rz', 'occlusion', 'truncation'))
                 for pose in item.findall('poses/item')]
        kind = item.findtext('objectType') or ''
        found.append((NAMES.get(kind, kind), size, int(number(item, 'first_frame', path)), poses))
    if not found:
        raise UsageError(f'{path}: no tracklets/item in it')
    return found


def matrix(values, name, columns, path):
    """The rows of a calibration's matrix."""
    numbers = [float(word) for word in values.get(name, [])]
    if not numbers or len(numbers) % columns:
        raise UsageError(f'{path}: no {name}')
    return [numbers[k:k + columns] for k in range(0, len(numbers), columns)]


def times(rows, vector):
    return [sum(a * b for a, b in zip(row, vector)) for row in rows]


class Cameras:
    """Where points of the Velodyne are in rectified camera 0, and in the left colour image."""

    def __init__(self, cam, velo, path):
        """`cam` and `velo` hold the words of the date's calibration files by name."""
        self.R, self.rect = matrix(velo, 'R', 3, path), matrix(cam, 'R_rect_00', 3, path)
        self.T = [row[0] for row in matrix(velo, 'T', 1, path)]
        self.P = matrix(cam, 'P_rect_02', 4, path)
        self.width, self.height = (int(float(word)) for word in cam['S_rect_02'])

    def turned(self, vector):
        return times(self.rect, times(self.R, vector))

    def place(self, point):
        return times(self.rect, [a + b for a, b in zip(times(self.R, point), self.T)])

    def box(self, corners):
        """(left, top, right, bottom) of points in camera 0, not cut to the image; None when one is not ahead."""
        seen = [times(self.P, [*point, 1.0]) for point in corners]
        if min(depth for _, _, depth in seen) < LEAST_AHEAD_M:
            return None
        u, v = [x / z for x, _, z in seen], [y / z for _, y, z in seen]
        return min(u), min(v), max(u), max(v)

    def cut(self, box):
        """The part of a box in the image, and the share that is outside."""
        left, top = max(0.0, box[0]), max(0.0, box[1])
        right, bottom = min(self.width - 1.0, box[2]), min(self.height - 1.0, box[3])
        area = max(0.0, right - left) * max(0.0, bottom - top)
        return (left, top, right, bottom), 1.0 - area / ((box[2] - box[0]) * (box[3] - box[1]))


def label(cameras, image, track, kind, size, pose):
    """One row of the tracking set's labels; None for an object that is not in the image."""
    x, y, z, yaw, occlusion, truncation = pose
    height, width, length = size
    if truncation >= OUT_OF_IMAGE:
        return None
    ahead, left = (math.cos(yaw), math.sin(yaw)), (-math.sin(yaw), math.cos(yaw))
    corners = [cameras.place([x + a * ahead[0] + b * left[0], y + a * ahead[1] + b * left[1], z + up])
               for a in (-length / 2, length / 2) for b in (-width / 2, width / 2) for up in (0.0, height)]
    whole = cameras.box(corners)
    if whole is None:
        return None
    box, outside = cameras.cut(whole)
    if box[2] - box[0] < LEAST_BOX_PX or box[3] - box[1] < LEAST_BOX_PX:
        return None
    foot, along = cameras.place([x, y, z]), cameras.turned([*ahead, 0.0])
    yaw_cam = math.atan2(-along[2], along[0])
    level = int(truncation) if truncation in (0, 1) else 1 if outside > 0.01 else 0
    hidden = int(occlusion) if occlusion in (0, 1, 2) else 3
    alpha = yaw_cam - math.atan2(foot[0], foot[2])
    numbers = [alpha, *box, height, width, length, *foot, yaw_cam]
    return f'{image} {track} {kind} {level} {hidden} ' + ' '.join(f'{value:.6f}' for value in numbers)


def labels(path, cam, velo):
    """The text of a label file. Raises UsageError for a file that is not one of tracklets."""
    cameras = Cameras(cam, velo, path)
    rows = []
    for track, (kind, size, first, poses) in enumerate(read(path)):
        for k, pose in enumerate(poses):
            row = label(cameras, first + k, track, kind, size, pose)
            if row:
                rows.append((first + k, track, row))
    return ''.join(row + '\n' for _, _, row in sorted(rows))
