"""Tables of a bench's runs. Each function returns (head, rows) with texts as cells."""
import collections
import math
import statistics

from plumb_tools.accuracy.bench import LENGTHS
from plumb_tools.figures import cell, mean, pooled, quantile, standard_deviation

ERROR_COLUMNS = ['t 10..50 m', 'r', 'sd of t', 't 100..800 m', 'r', 'sd of t']
QUANTITIES = {'ln_scale': 'scale', 'ln_height': 'height', 'pitch': 'pitch', 'roll': 'roll',
              'ln_step': 'step length'}
STATUSES_WITH_MOTION = ('ok', 'scale_held', 'standstill', 'coasting')


def _error_cells(bench, mode, drives):
    """Means over the seeds of the errors pooled over the drives, and the spread of t over seeds."""
    cells = []
    for kind in LENGTHS:
        per_seed = [pooled([bench.report(mode, seed, drive, kind)['pooled'] for drive in drives])
                    for seed in bench.seeds]
        per_seed = [error for error in per_seed if error]
        t, r = [error[0] for error in per_seed], [error[1] for error in per_seed]
        cells += [cell(mean(t)), cell(mean(r), 4), cell(standard_deviation(t), 3)]
    return cells


def accuracy(bench):
    """Errors of each mode over all drives."""
    return ['mode'] + ERROR_COLUMNS, [[mode] + _error_cells(bench, mode, bench.drives) for mode in bench.modes]


def accuracy_per_drive(bench):
    rows = [[drive, mode] + _error_cells(bench, mode, [drive]) for drive in sorted(bench.drives)
            for mode in bench.modes]
    return ['drive', 'mode'] + ERROR_COLUMNS, rows


def heights(bench):
    """Errors of the plane for the drives with true planes."""
    head = ['drive', 'mode', 'mean height error %', 'within 7 %, %', 'pitch mean deg', 'pitch sd deg', 'frames']
    rows = []
    for drive in bench.drives:
        for mode in bench.modes:
            reports = [bench.report(mode, seed, drive, 'plane') for seed in bench.seeds]
            reports = [report for report in reports if report]
            if reports:
                rows.append([drive, mode] + _height_cells(reports))
    return head, rows


def _height_cells(reports):
    return [cell(mean([r['height_error_mean_percent'] for r in reports])),
            cell(mean([100 * r['within_7_percent_ratio'] for r in reports]), 1),
            cell(mean([r['pitch']['mean_deg'] for r in reports])),
            cell(mean([r['pitch']['std_deg'] for r in reports])),
            f"{reports[0]['num_compared']} / {reports[0]['num_true']}"]


def success(bench):
    """How many frames had a motion, and when the first one came."""
    head = ['mode', 'runs', 'frames', 'with motion %', 'lost', 'resets', 'first motion at frame, median / worst',
            'statuses']
    return head, [[mode] + _success_cells(bench, mode) for mode in bench.modes]


def _success_cells(bench, mode):
    counts, num_resets, first_frames = collections.Counter(), 0, []
    for drive in bench.drives:
        for seed in bench.seeds:
            frames = bench.frames(mode, seed, drive)
            counts.update(frame['ego_status'] or 'refused' for frame in frames)
            num_resets += int(frames[-1]['reset_counter'] or 0)
            with_scale = (i for i, frame in enumerate(frames) if frame['ego_status'] in ('ok', 'scale_held'))
            first_frames.append(next(with_scale, len(frames)))
    total = sum(counts.values())
    with_motion = sum(counts[status] for status in STATUSES_WITH_MOTION)
    return [str(len(first_frames)), str(total), cell(100 * with_motion / max(1, total), 1), str(counts['lost']),
            str(num_resets), f'{statistics.median(first_frames):.0f} / {max(first_frames)}',
            ', '.join(f'{n} {status}' for status, n in counts.most_common())]


def calibration(scores):
    """How well stated variances fit the errors. `scores`: {mode: entries of plumb-train score}."""
    rows = []
    for mode, entries in scores.items():
        row = [mode]
        for quantity in QUANTITIES:
            values = [e['score']['nees'] for e in entries if e['quantity'] == quantity]
            within = sum(0.7 <= v <= 1.5 for v in values)
            row.append(f'{cell(mean(values))} ({within} of {len(values)})' if values else '-')
        rows.append(row)
    return ['mode'] + list(QUANTITIES.values()), rows


def calibration_per_drive(scores, drives):
    rows = []
    for drive in sorted(drives):
        for mode, entries in scores.items():
            values = {e['quantity']: e['score']['nees'] for e in entries if e['drive'] == drive}
            if values:
                rows.append([drive, mode] + [cell(values.get(quantity)) for quantity in QUANTITIES])
    return ['drive', 'mode'] + list(QUANTITIES.values()), rows


def times(bench):
    """Wall time of every stage with the first seed."""
    rows = []
    for mode in bench.modes:
        stages = collections.defaultdict(list)
        for drive in bench.drives:
            for frame in bench.frames(mode, bench.first_seed, drive):
                _add_times(frame, stages)
        rows += [[mode, name, cell(1e-3 * quantile(values, 0.5)), cell(1e-3 * quantile(values, 0.99))]
                 for name, values in stages.items()]
    return ['mode', 'stage', 'median ms', 'p99 ms'], rows


def _add_times(frame, stages):
    for part in ('vo', 'ground'):
        if frame.get(part + '_us'):
            stages[part + ' total'].append(float(frame[part + '_us']))
        for word in (frame.get(part + '_stages_us') or '').split():
            name, _, value = word.partition('=')
            stages[f'{part} {name}'].append(float(value))


def relative_height_errors(frames, truth, nominal_height_m):
    """{'dense', 'points', 'fused': [(frame, error in percent)]}.

    `truth` holds true heights by frame; an empty one stands for the nominal height in every frame.
    """
    curves = {name: [] for name in ('dense', 'points', 'fused')}
    for frame in frames:
        seq = int(frame['seq'])
        true_m = truth.get(seq, None if truth else nominal_height_m)
        if true_m is None or not frame['log_scale'] or not frame['height_m'] or frame['plane_status'] != 'ok':
            continue
        scale = math.exp(float(frame['log_scale']))
        for cue in ('dense', 'points'):
            if frame[cue + '_height_vo'] and frame[cue + '_status'] == 'used':
                height_m = float(frame[cue + '_height_vo']) * scale
                curves[cue].append((seq, 100 * (height_m / true_m - 1)))
        curves['fused'].append((seq, 100 * (float(frame['height_m']) / true_m - 1)))
    return curves
