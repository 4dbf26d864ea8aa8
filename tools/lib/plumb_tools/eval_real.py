"""Converts, replays and evaluates every KITTI drive below a folder: the tool tools/eval_real."""
import json
import pathlib
import re
import shutil
import tempfile

from plumb_tools import command_line
from plumb_tools.figures import pooled
from plumb_tools.programs import OUT, Programs, add_bin_option, find_drives, is_newer, planes_of

LENGTHS = {'short': '10,20,50', 'long': 'new'}
TABLE_HEAD = (
    't [%] / r [deg/m] by the KITTI metric; scale: estimated / true length of 10 m windows, median and spread;\n'
    'plane: mean height error [%], frames within 7 % [%], pitch error mean and sd [deg]; times per frame [ms]: '
    'median and p99 of wall time, mean of processor time\n'
    f"{'drive':<20} {'frame':>5} {'path m':>6} | {'10, 20, 50 m':<15} | {'100..800 m':<15} | {'scale':<12} | "
    f"{'plane':<21} | {'vo':<11} | {'ground':<11} | {'cpu':>5} | {'fr/s':>6} | ego status")


def replay_drive(name, drive, options, programs):
    """Leaves the drive's log, poses, table, CAN trace and what plumb-eval says about its planes."""
    out = options.out
    log, frames = out / 'logs' / f'{name}.lcm', out / f'{name}.csv'
    if not is_newer(log, drive / 'poses.txt'):
        programs.run('plumb-kitti2lcm', drive, '--out', log)
    settings = [word for flag, value in (('--config', options.config), ('--seed', options.seed)) if value is not None
                for word in (flag, value)]
    programs.run('plumb-replay', log, '--poses', out / 'estimate' / f'{name}.txt', '--csv', frames, '--can',
                 out / f'{name}.can', *settings, log=out / f'{name}.replay.txt')
    shutil.copyfile(drive / 'poses.txt', out / 'truth' / f'{name}.txt')
    report = out / f'{name}.plane.json'
    report.unlink(missing_ok=True)
    planes = planes_of(drive)
    if planes:
        programs.run('plumb-eval', 'plane', planes, frames, '--json', report, log=out / f'{name}.plane.txt')


def evaluate(names, options, programs):
    """{'short', 'long': what plumb-eval says by drive}, of these drives alone.

    The folder may hold drives of an earlier run.
    """
    reports = {}
    with tempfile.TemporaryDirectory() as folder:
        pick = pathlib.Path(folder)
        for kind in ('truth', 'estimate'):
            (pick / kind).mkdir()
            for name in names:
                (pick / kind / f'{name}.txt').symlink_to((options.out / kind / f'{name}.txt').absolute())
        for kind, lengths in LENGTHS.items():
            report = options.out / f'eval_{kind}.json'
            pictures = ['--plots', options.out / 'plots'] if options.plots and kind == 'long' else []
            programs.run('plumb-eval', '--gt-dir', pick / 'truth', '--est-dir', pick / 'estimate', '--lengths',
                         lengths, '--json', report, *pictures, log=options.out / f'eval_{kind}.txt')
            reports[kind] = {s['name']: s for s in json.loads(report.read_text())['sequences']}
    return reports


def summary_of(text):
    """What plumb-replay printed, as cells.

    They are median and 99th percentile of vo and ground, processor time, rate and statuses.
    """
    totals = [line.split() for line in text.splitlines() if line.split()[:1] == ['total']]
    rate = re.search(r'([\d.]+) frames/s', text).group(1)
    cpu = re.search(r'([\d.]+) ms of processor time', text).group(1)
    statuses = re.search(r'^  ego +(.*)$', text, re.M).group(1)
    vo, ground = totals[0][2:4], totals[1][2:4]
    return (f'{vo[0]:>5} {vo[1]:>5} | {ground[0]:>5} {ground[1]:>5} | {cpu:>5} | {rate:>6} | {statuses}')


def error_cell(errors):
    """'t / r', or a dash without segments."""
    return '       -       ' if errors is None else f'{errors[0]:6.2f} / {errors[1]:.4f}'


def plane_cell(path):
    if not path.exists():
        return '          -          '
    p = json.loads(path.read_text())
    return (f"{p['height_error_mean_percent']:5.2f} {100 * p['within_7_percent_ratio']:5.0f} "
            f"{p['pitch']['mean_deg']:5.2f} {p['pitch']['std_deg']:5.2f}")


def table(names, reports, out):
    """Lines of the table: one per drive, then the pooled ones."""
    short, long_ = reports['short'], reports['long']
    lines = [TABLE_HEAD]
    for name in names:
        s = short[name]
        windows = s['scale_windows']
        lines.append(
            f"{name:<20} {s['num_frames']:5d} {s['path_m']:6.0f} | {error_cell(pooled([s]))} | "
            f"{error_cell(pooled([long_[name]]))} | {windows['median'] or 0:.3f}  {windows['spread'] or 0:.3f} | "
            f"{plane_cell(out / f'{name}.plane.json')} | " + summary_of((out / f'{name}.replay.txt').read_text()))
    brief = [name for name in names if not long_[name]['num_segments']]
    lengthy = [name for name in names if long_[name]['num_segments']]
    if brief:
        errors = error_cell(pooled([short[name] for name in brief]))
        lines.append(f"{'pooled, drives below 100 m':<33} | {errors} |")
    if lengthy:
        errors = [error_cell(pooled([report[name] for name in lengthy])) for report in (short, long_)]
        lines.append(f"{'pooled, longer drives':<33} | {errors[0]:<15} | {errors[1]} |")
    return lines


def main():
    parser = command_line.Parser('eval_real')
    parser.add_argument('data', metavar='KITTI_DIR', type=command_line.folder)
    parser.add_argument('--out', type=pathlib.Path, default=OUT / 'real')
    parser.add_argument('--config', type=command_line.file)
    parser.add_argument('--seed', type=command_line.at_least(0))
    parser.add_argument('--plots', action='store_true')
    add_bin_option(parser)
    options = parser.parse_args()
    programs = Programs(options.bin, 'plumb-kitti2lcm', 'plumb-replay', 'plumb-eval')
    drives = find_drives(options.data)
    for name in ('logs', 'truth', 'estimate'):
        (options.out / name).mkdir(parents=True, exist_ok=True)
    for name, drive in drives.items():
        replay_drive(name, drive, options, programs)
    text = '\n'.join(table(list(drives), evaluate(drives, options, programs), options.out)) + '\n'
    (options.out / 'table.txt').write_text(text)
    print(text, end='')
