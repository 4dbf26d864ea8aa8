"""Pictures of a bench's runs: paths from above, height errors, errors by length and by speed."""
import collections

from plumb_tools import drive_files, gnuplot
from plumb_tools.accuracy.bench import LENGTHS
from plumb_tools.accuracy.tables import relative_height_errors
from plumb_tools.figures import pooled
from plumb_tools.programs import planes_of

NOMINAL_HEIGHT_M = 1.65


def top_view(poses):
    """(right, ahead) of every pose in the frame of the first camera."""
    first = poses[0]
    points = []
    for pose in poses:
        moved = [pose[4 * k + 3] - first[4 * k + 3] for k in range(3)]
        points.append(tuple(sum(first[4 * k + axis] * moved[k] for k in range(3)) for axis in (0, 2)))
    return points


def draw_all(bench):
    """Draws every picture; returns the names of those that have anything to show."""
    names = []
    for drive in bench.drives:
        names += [_draw_path(bench, drive)] + [_draw_heights(bench, mode, drive) for mode in bench.modes]
    for kind in LENGTHS:
        names += [_draw_errors(bench, kind, 'by_length', 'length_m', 'segment length [m]'),
                  _draw_errors(bench, kind, 'by_speed', 'speed_m_s', 'speed [m/s]')]
    return [name for name in names if name]


def _draw_path(bench, drive):
    files = {'truth': bench.drives[drive] / 'poses.txt'}
    files.update({mode: bench.path(mode, bench.first_seed, drive, '.txt') for mode in bench.modes})
    curves = [gnuplot.Curve(name, top_view(drive_files.read_poses(path))) for name, path in files.items()]
    name = 'path_' + drive
    drawn = gnuplot.draw(bench.picture(name), f'{drive}, seen from above', 'right [m]', 'ahead [m]', curves, True)
    return name if drawn else None


def _draw_heights(bench, mode, drive):
    planes = planes_of(bench.drives[drive])
    truth = drive_files.read_plane_heights(planes) if planes else {}
    errors = relative_height_errors(bench.frames(mode, bench.first_seed, drive), truth, NOMINAL_HEIGHT_M)
    curves = [gnuplot.Curve(cue, points, dots=cue != 'fused') for cue, points in errors.items()]
    reference = 'true planes' if truth else f'the nominal {NOMINAL_HEIGHT_M:.2f} m'
    name = f'height_{drive}_{mode}'
    drawn = gnuplot.draw(bench.picture(name), f'{drive}, {mode}: height error against {reference}', 'frame',
                         'percent', curves)
    return name if drawn else None


def _draw_errors(bench, kind, by, key, label):
    curves = []
    for mode in bench.modes:
        bins = collections.defaultdict(list)
        for drive in bench.drives:
            for entry in bench.report(mode, bench.first_seed, drive, kind)['pooled'][by]:
                bins[entry[key]].append(entry)
        points = [(k, pooled(entries)[0]) for k, entries in sorted(bins.items()) if pooled(entries)]
        curves.append(gnuplot.Curve(mode, points))
    lengths = LENGTHS[kind].replace('new', '100..800')
    name = f'error_{by}_{kind}'
    drawn = gnuplot.draw(bench.picture(name), f'translation error, lengths {lengths}', label, 'percent', curves)
    return name if drawn else None
