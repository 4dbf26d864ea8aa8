"""Readers of the text files that drives, plumb-replay and plumb-can leave. All raise UsageError."""
import csv
import math

from plumb_tools.command_line import UsageError


def read_rows(path, least=1):
    """Rows of numbers with at least so many cells; lines that begin with # are comments."""
    rows = []
    with open(path) as file:
        for number, line in enumerate(file, 1):
            if not line.strip() or line.startswith('#'):
                continue
            try:
                row = [float(cell) for cell in line.replace(',', ' ').split()]
            except ValueError:
                raise UsageError(f'{path}:{number}: not a row of numbers') from None
            if len(row) < least:
                raise UsageError(f'{path}:{number}: fewer than {least} numbers')
            rows.append(row)
    return rows


def read_poses(path):
    """KITTI poses: rows of 12 numbers."""
    return read_rows(path, 12)


def positions(poses):
    """The translations of KITTI poses."""
    return [(p[3], p[7], p[11]) for p in poses]


def read_plane_heights(path):
    """{frame: height in metres} of a file with rows 'frame nx ny nz height_m ...'."""
    return {int(row[0]): row[4] for row in read_rows(path, 5)}


def read_frames(path):
    """The table that plumb-replay writes with --csv: one dictionary of texts per frame."""
    with open(path, newline='') as file:
        frames = list(csv.DictReader(file))
    if not frames or 'vo_status' not in frames[0] or 'log_scale' not in frames[0]:
        raise UsageError(f'{path}: not a table of plumb-replay --csv')
    return frames


def number(text):
    """The number in a table's cell; NaN for an empty one."""
    return float(text) if text else math.nan
