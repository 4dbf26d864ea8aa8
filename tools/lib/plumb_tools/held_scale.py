"""Gives the path with one scale for the whole drive: the tool tools/evaluate/held_scale."""
import math
import statistics

from plumb_tools import command_line
from plumb_tools.command_line import UsageError
from plumb_tools.drive_files import number, read_frames, read_poses

FIRST, LAST = 5, 10  # of the frames with a measured scale: past the start, and still the beginning


def inverse(pose):
    """The inverse of a rigid transform, given as three rows of four numbers."""
    turned = [[pose[j][i] for j in range(3)] for i in range(3)]
    moved = [-sum(turned[i][k] * pose[k][3] for k in range(3)) for i in range(3)]
    return [turned[i] + [moved[i]] for i in range(3)]


def product(a, b):
    """The product a b of two rigid transforms."""
    return [[sum(a[i][k] * b[k][j] for k in range(3)) + (a[i][3] if j == 3 else 0.0) for j in range(4)]
            for i in range(3)]


def first_log_scale(frames):
    """Mean ln(metres per unit) of the sixth to the tenth frame whose scale was measured."""
    known = [number(frame['log_scale']) for frame in frames if frame['ego_status'] == 'ok']
    if len(known) < LAST:
        raise UsageError(f'the table has {len(known)} frames with status ok, fewer than {LAST}')
    return statistics.fmean(known[FIRST:LAST])


def held(poses, frames):
    """The poses with the length that every step would have with the first scale."""
    log_scale = first_log_scale(frames)
    path = [poses[0]]
    for before, pose, frame in zip(poses, poses[1:], frames[1:]):
        step = product(inverse(before), pose)
        now = number(frame['log_scale'])
        factor = math.exp(log_scale - now) if frame['ego_status'] != 'initializing' and math.isfinite(now) else 1.0
        path.append(product(path[-1], [row[:3] + [factor * row[3]] for row in step]))
    return path


def main():
    parser = command_line.Parser('held_scale')
    parser.add_argument('poses', metavar='POSES', type=command_line.file)
    parser.add_argument('csv', metavar='CSV', type=command_line.file)
    parser.add_argument('out', metavar='OUT')
    options = parser.parse_args()
    command_line.refuse_overwriting({'POSES': options.poses, 'CSV': options.csv}, {'OUT': options.out})
    poses = [[list(row[4 * i:4 * i + 4]) for i in range(3)] for row in read_poses(options.poses)]
    frames = read_frames(options.csv)
    if len(frames) != len(poses):
        raise UsageError(f'{options.csv} has {len(frames)} frames, {options.poses} {len(poses)} poses')
    with open(options.out, 'w') as file:
        for pose in held(poses, frames):
            file.write(' '.join('%.12g' % value for row in pose for value in row) + '\n')
