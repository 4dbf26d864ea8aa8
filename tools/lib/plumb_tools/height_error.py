"""Height errors of the fused plane and of each cue: the tool tools/evaluate/height_error."""
import json
import math
import statistics

from plumb_tools import command_line
from plumb_tools.command_line import UsageError
from plumb_tools.drive_files import number, positions, read_frames, read_plane_heights, read_poses

REACH_FRAMES = 2
CUES = ('dense', 'points')


def metres_per_vo_unit(frames, places):
    """True path over VO's path around each frame that VO measured; NaN for the other frames."""
    def vo_step(k):
        return math.hypot(*(number(frames[k]['vo_t_' + axis]) for axis in 'xyz'))

    ratios = []
    for k, frame in enumerate(frames):
        near = [j for j in range(max(1, k - REACH_FRAMES), min(len(frames), k + REACH_FRAMES + 1))
                if frames[j]['vo_status'] == 'ok' and frames[j]['scale_epoch'] == frame['scale_epoch']]
        path_vo = sum(vo_step(j) for j in near)
        path_m = sum(math.dist(places[j], places[j - 1]) for j in near)
        ratios.append(path_m / path_vo if frame['vo_status'] == 'ok' and path_vo > 0 else math.nan)
    return ratios


def height_errors(frames, places, planes, height_m):
    """{'fused', 'dense', 'points': errors in percent of the true height}.

    `planes` holds true heights by frame; `height_m` stands in where there is none, and turns the
    filter's scale into a height.
    """
    errors = {name: [] for name in ('fused',) + CUES}
    for frame, ratio in zip(frames, metres_per_vo_unit(frames, places)):
        true_m = planes.get(int(frame['seq']), height_m)
        heights_vo = {cue: number(frame[cue + '_height_vo']) for cue in CUES
                      if frame[cue + '_status'] == 'used'}
        if frame['plane_status'] in ('ok', 'held'):
            heights_vo['fused'] = height_m * math.exp(-number(frame['log_scale']))
        for name, height_vo in heights_vo.items():
            if math.isfinite(height_vo * ratio):
                errors[name].append(100.0 * (height_vo * ratio / true_m - 1.0))
    return errors


def summary(errors):
    """The number of errors, their mean size, their mean, and the share within 7 %."""
    if not errors:
        return {'frames': 0}
    return {'frames': len(errors),
            'mean_percent': statistics.fmean(map(abs, errors)),
            'bias_percent': statistics.fmean(errors),
            'within_7_percent_ratio': sum(abs(e) <= 7.0 for e in errors) / len(errors)}


def line_of(name, errors):
    """One printed line."""
    line = f'{name:<7} {len(errors):5d} frames'
    if errors:
        s = summary(errors)
        line += (f"  mean {s['mean_percent']:6.2f} %  bias {s['bias_percent']:6.2f} %"
                 f"  within 7 %: {100 * s['within_7_percent_ratio']:3.0f} %")
    return line


def main():
    parser = command_line.Parser('height_error')
    parser.add_argument('poses', metavar='POSES', type=command_line.file)
    parser.add_argument('csv', metavar='CSV', type=command_line.file)
    parser.add_argument('--planes', type=command_line.file)
    parser.add_argument('--height', type=command_line.at_least(0.1, float), default=1.65)
    parser.add_argument('--json')
    options = parser.parse_args()
    command_line.refuse_overwriting(
        {'POSES': options.poses, 'CSV': options.csv, '--planes': options.planes},
        {'--json': options.json})
    places, frames = positions(read_poses(options.poses)), read_frames(options.csv)
    if len(frames) != len(places):
        raise UsageError(f'{options.csv} has {len(frames)} frames, {options.poses} {len(places)} poses')
    planes = read_plane_heights(options.planes) if options.planes else {}
    errors = height_errors(frames, places, planes, options.height)
    for name, of_cue in errors.items():
        print(line_of(name, of_cue))
    if options.json:
        with open(options.json, 'w') as file:
            json.dump({name: dict(summary(e), errors_percent=e) for name, e in errors.items()}, file)
