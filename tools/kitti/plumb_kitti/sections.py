"""The sections of the report, in the paper's order. Each takes Results and returns a section."""
import math
import statistics

from plumb_kitti import paper_values
from plumb_kitti.blocks import band, bars, curve, lines, note, section, table
from plumb_kitti.results import CURVES, measured, read_json
from plumb_tools.figures import cell

MODE_NAMES = {'default': 'default', 'fixed': 'default, fixed covariances', 'paper': 'paper, adaptive',
              'paper-fixed': 'paper, fixed', 'paper-dense': 'paper, dense alone', 'paper-points': 'paper, points alone'}
LEAST_BLOCKS = 8  # an interval from fewer blocks is no more than a hint
LENGTH_NAMES = {'short': '10, 20, 50 m', 'long': '100 to 800 m'}


def pair(errors):
    return '-' if errors is None else f'{errors[0]:.2f} / {errors[1]:.4f}'


def interval(entry):
    return f"{entry['mean']:.2f} ({entry['low']:.2f} to {entry['high']:.2f})"


def verdict(comparison):
    difference = comparison['difference']
    if comparison['num_blocks'] < LEAST_BLOCKS:
        return 'too few images to tell'
    if difference['high'] < 0:
        return 'the first is better'
    return 'the second is better' if difference['low'] > 0 else 'not told apart'


def comparison_table(results, measures, caption):
    rows = [[c['drives'], c['title'] + ('' if c['measure'] == 'height' else ', ' + LENGTH_NAMES[c['measure']]),
             c['num_blocks'], interval(c['of']), interval(c['against']), interval(c['difference']),
             verdict(c)] for c in results.comparisons if c['measure'] in measures]
    head = ['drives', 'comparison', 'blocks', 'first %', 'second %', 'difference', 'verdict']
    return table(head, rows, caption) if rows else None


def data_section(results):
    rows = []
    for name, drive in results.plan['drives'].items():
        run = results.runs.get((name, 'default', 0), {})
        facts = drive['camera_facts']
        truth = 'poses' if drive['poses'] else 'oxts' if drive['oxts'] else 'none'
        planes = 'given' if drive['planes'] else 'scans' if drive['velodyne'] else 'none'
        rows.append([name, drive['kind'], drive['num_images'], cell(run.get('path_m'), 0), truth, planes, drive['rig'],
                     cell(facts['fx_px'], 1), cell(facts['height_m'])])
    head = ['drive', 'set', 'images', 'path m', 'truth', 'true planes', 'rig', 'fx px', 'stated height m']
    missing = [[m['section'], m['what'], m['download']] for m in results.plan['missing']]
    return section('data', 'Data', [table(head, rows, 'What was found, with the camera as each calibration states it.'),
                                    table(['for', 'not here', 'download'], missing, 'What is missing, and where it is.')])


def variance_cell(values, digits):
    return '-' if len(values) < 2 else f'{statistics.variance(values):.{digits}g}'


def table_1(results):
    head = ['drive', 'method', 'segments', 'runs', 't %, mean', 't, variance', 'r deg/m, mean', 'r, variance']
    rows, has_long = [], False
    for drive in results.with_truth():
        for mode in results.plan['modes']:
            for kind in LENGTH_NAMES:
                trials = results.trials(drive, mode, kind)
                if not trials:
                    continue
                has_long = has_long or kind == 'long'
                t, r = [e[0] for e in trials], [e[1] for e in trials]
                rows.append([drive, MODE_NAMES[mode], LENGTH_NAMES[kind], len(trials), cell(statistics.fmean(t), 3),
                             variance_cell(t, 2), cell(statistics.fmean(r), 5), variance_cell(r, 2)])
    for mode in results.plan['modes']:
        for kind in LENGTH_NAMES:
            errors = results.errors(results.with_truth(), mode, kind)
            if errors:
                rows.append(['all, pooled', MODE_NAMES[mode], LENGTH_NAMES[kind], 'undisturbed', cell(errors[0], 3), '',
                             cell(errors[1], 5), ''])
    for system, drives in results.plan['others'].items():
        for drive in drives:
            entry = read_json(results.out / 'others' / system / f'{drive}.json') or {}
            rows += [[drive, system, LENGTH_NAMES[kind], 1, cell(entry[kind]['t_percent'], 3), '',
                      cell(entry[kind]['r_deg_m'], 5), ''] for kind in LENGTH_NAMES if entry.get(kind, {}).get('num_segments')]
    paper = table(['method', 'rotation deg/m', 'translation %'], paper_values.TABLE_1,
                  'The paper: means over sequences 0 to 10 in full, 50 trials, 100 to 800 m.')
    text = ('A trial begins up to 30 images later, has noise of 0.5 to 3 grey levels on every pixel, lacks up to 3 % of the '
            'images and has another seed. Variance is over the trials, the undisturbed run among them.')
    blocks = [note(text), table(head, rows) if rows else None, paper,
              comparison_table(results, ('short', 'long'), 'Means with 95 % intervals, from blocks of 20 images drawn anew.')]
    if rows and not has_long:
        blocks.insert(1, note('No drive here is longer than 100 m, so the lengths of the benchmark have no segment.'))
    return section('table1', 'Table 1: accuracy and robustness', blocks)


def figure_1(results):
    charts = []
    for drive in results.with_truth():
        files = {'truth': results.folder(drive, 'default') / 'truth.txt'}
        files.update({MODE_NAMES[m]: results.folder(drive, m) / 'poses.txt' for m in results.plan['modes']
                      if m in ('default', 'paper')})
        curves = [curve(name, results.path_from_above(path)) for name, path in files.items()]
        charts.append(lines(f'{drive}, seen from above', 'right [m]', 'ahead [m]', curves, True))
    return section('fig1', 'Fig. 1: paths', charts)


def figure_9(results):
    charts = []
    for drive in results.with_truth():
        curves = [curve(name, results.height_curve(drive, name), dots='alone' in name) for name in CURVES]
        reference = 'true planes' if results.true_planes(drive) else 'the stated height'
        charts.append(lines(f'{drive}: height by the true step, against {reference}', 'image', 'error [%]', curves))
    text = ('The height in [vo] becomes metres by the true length of the step. The constant stands for the trivial answer: the '
            'stated height in every image. Where there is no true plane, the stated height is the reference, and the constant '
            'is right by definition.')
    return section('fig9', 'Fig. 9: height error over each sequence', [note(text)] + charts,
                   'Sequences 2 and 5: the fused curve is much less spiky than either cue.')


def figure_10(results):
    drives = results.with_truth()
    rows, success = [], []
    for drive in drives:
        for name in CURVES:
            summary = results.heights(drive, name)
            if summary:
                rows.append((drive, name, summary['mean_percent']))
                success.append((drive, name, 100 * summary['within_7_percent_ratio']))
    lidar = [drive for drive in drives if results.true_planes(drive)]
    pooled = []
    for name in CURVES:
        cells = []
        for group in (drives if name != 'constant' else [], lidar):
            mean, within = (results.pooled_height(group, name, key) for key in ('mean_percent', 'within_7_percent_ratio'))
            cells += [cell(mean), cell(within and 100 * within, 1)]
        pooled.append([name, *cells, cell(paper_values.HEIGHT_ERROR.get(name))])
    head = ['', 'all drives: mean error %', 'within 7 %', 'drives with true planes: mean error %', 'within 7 %',
            'the paper, mean error %']
    return section('fig10', 'Fig. 10: error and robustness of the ground plane', [
        table(head, pooled, 'Pooled over images.') if drives else None,
        bars('Mean of the absolute height error by the true step', 'error [%]', rows),
        bars('Images whose height error is below 7 %', 'share [%]', success),
        comparison_table(results, ('height',), 'Which is better: means with 95 % intervals.')],
        'Adaptive 3.97 %, fixed 4.57 %, dense 6.64 %, points 11.23 %; success 75 to 100 % in every sequence.')


def figure_11(results):
    charts = []
    names = [(MODE_NAMES[m], [results.runs[d, m, 0] for d in results.with_truth() if (d, m, 0) in results.runs])
             for m in results.plan['modes']]
    names += [(system, [e for d in drives if (e := read_json(results.out / 'others' / system / f'{d}.json'))])
              for system, drives in results.plan['others'].items()]
    for kind, title in LENGTH_NAMES.items():
        for by, key, label in (('by_length', 'length_m', 'segment length [m]'), ('by_speed', 'speed_m_s', 'speed [m/s]')):
            for value, unit in (('t_percent', 'translation [%]'), ('r_deg_m', 'rotation [deg/m]')):
                curves = [curve(name, pooled_bins([run[kind][by] for run in runs], key, value)) for name, runs in names]
                charts.append(lines(f'{unit.partition(" [")[0].capitalize()} error, segments of {title}', label, unit, curves))
    server = [d['name'] for d in results.plan['drives'].values() if d['kind'] == 'odometry' and d['number'].isdigit()
              and 11 <= int(d['number']) <= 21]
    text = (f"results.zip holds {', '.join(server)} in the layout of the benchmark's server." if server else
            'No sequence of 11 to 21 is here; the folder results has every path in the same format.')
    return section('fig11', 'Fig. 11: comparison with other systems', charts + [note(text)],
                   'On sequences 11 to 21 by the server: 0.0054 deg per image and 3.21 %.')


def pooled_bins(lists, key, value):
    """[(at, mean over segments)] of the bins of several runs."""
    sums = {}
    for entry in (entry for entries in lists for entry in entries):
        if entry['num_segments']:
            total = sums.setdefault(entry[key], [0, 0.0])
            total[0] += entry['num_segments']
            total[1] += entry['num_segments'] * entry[value]
    return [(at, total / num) for at, (num, total) in sorted(sums.items())]


def plane_section(results):
    charts, rows = [], []
    for drive in results.with_truth():
        truth, run = results.true_planes(drive), results.runs[drive, 'default', 0]
        if not truth:
            continue
        frames = measured(results.frames(drive), 'seq', 'pitch_rad', 'pitch_std_rad')
        estimate = [(f, math.degrees(p), math.degrees(s)) for f, p, s in frames]
        charts.append(lines(f'{drive}: pitch, with a band of one stated standard deviation', 'image', 'pitch [deg]',
                            [band('default', estimate), curve('truth', sorted((f, p) for f, (p, _) in truth.items()))]))
        plane = run.get('plane')
        if plane:
            rows.append([drive, plane['num_compared'], cell(plane['pitch']['mean_deg']), cell(plane['pitch']['std_deg']),
                         cell(plane['roll']['mean_deg']), cell(plane['roll']['std_deg']),
                         cell(plane['pitch_calibration']['nees'])])
    checks = [[path.stem, c['num_frames'], cell(1000 * c['height_rms_m'], 1), cell(c['pitch_rms_deg'], 3),
               cell(c['roll_rms_deg'], 3)] for path in sorted((results.out / 'planes').glob('*.json'))
              if (c := read_json(path))]
    head = ['drive', 'images', 'pitch mean deg', 'sd', 'roll mean deg', 'sd', 'pitch, squared error / variance']
    return section('plane', 'The plane against its truth', [
        table(head, rows, 'Default mode minus truth.') if rows else None, *charts,
        table(['drive', 'scans', 'height mm rms', 'pitch deg rms', 'roll deg rms'], checks,
              'Planes that were fitted to scans here, against the given ones.') if checks else None])


def runs_section(results, failed):
    rows = [[d, MODE_NAMES[m], t, run['num_frames'], ', '.join(f'{n} {s}' for s, n in sorted(run['ego_status'].items()))]
            for (d, m, t), run in results.runs.items()]
    rigs = [[p.stem, ', '.join(r['drives']), r['num_frames'], cell(math.degrees(r['pitch_rad'])),
             cell(math.degrees(r['roll_rad']))] for p in sorted((results.out / 'rigs').glob('*.json')) if (r := read_json(p))]
    return section('runs', 'Runs', [
        table(['job that failed twice', 'what it said'], sorted(failed.items())) if failed else None,
        table(['rig', 'drives', 'images', 'pitch deg', 'roll deg'], rigs, 'The mount of each rig, found without truth: medians '
              'of the default mode. The published method runs with it.') if rigs else None,
        table(['drive', 'mode', 'trial', 'images', 'status of the motion'], rows)])
