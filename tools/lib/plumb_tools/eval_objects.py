"""Places the boxes of drives with several ground planes: the tool tools/evaluate/eval_objects."""
import json
import pathlib

from plumb_tools import command_line
from plumb_tools.command_line import UsageError
from plumb_tools.figures import cell
from plumb_tools.programs import OUT, Programs, add_bin_option

PLANES = {
    'calibrated': '[objects]\nplane = "calibrated"\n',
    'dense': '[ground]\nmode = "paper"\ncues = "dense"\n',
    'paper-fixed': '[ground]\nmode = "paper"\ncovariance = "fixed"\n',
    'paper-adaptive': '[ground]\nmode = "paper"\n',
    'fixed': '[ground]\ncovariance = "fixed"\n',
    'ours': '',
}
VEHICLES = ('car', 'van', 'truck', 'bus')
TABLE_HEAD = (
    'error in % of the true depth, mean over all drives; '
    'object: plumb-objects on that plane, foot: the foot point alone\n'
    f"{'':<15} {'':>6} | {'close (<= 10 m)':<34} | {'distant':<34}\n"
    f"{'plane':<15} {'placed':>6} |" + 2 * '     n   foot object median   NEES |')


def table_row(plane, figures):
    """The line of a plane. `figures` is what plumb-eval placed says over all drives."""
    line = f"{plane:<15} {100 * figures['num_placed'] / max(figures['num_labels'], 1):5.0f}% |"
    for reach in ('close', 'distant'):
        f = figures[reach]['all']
        cells = [cell(f['foot_depth_error_percent'], 1), cell(f['depth_error_percent'], 1),
                 cell(f['depth_error_median_percent'], 1), cell(f['depth_nees'])]
        line += f"{f['num_samples']:6d} " + ' '.join(f'{text:>6}' for text in cells) + ' |'
    return line


def convert(drives, boxes, out, programs):
    """{drive: its log, with the boxes on DETECTIONS}."""
    (out / 'logs').mkdir(parents=True, exist_ok=True)
    logs = {drive: out / 'logs' / f'{drive.name}.lcm' for drive in drives}
    for drive, log in logs.items():
        programs.run('plumb-kitti2lcm', drive, '--detections', drive / boxes, '--out', log)
    return logs


def evaluate(plane, logs, options, programs):
    """Replays every log on a plane; returns what plumb-eval placed says over all drives."""
    out, tables = options.out, []
    config = out / f'{plane}.toml'
    config.write_text(PLANES[plane])
    for drive, log in logs.items():
        frames, objects = (out / f'{drive.name}.{plane}{end}' for end in ('.csv', '.objects.csv'))
        programs.run('plumb-replay', log, '--config', config, '--csv', frames, '--objects', objects,
                     log=out / f'{drive.name}.{plane}.replay.txt')
        tables += [drive, frames, objects]
    pictures = ['--plots', out / 'plots' / plane] if options.plots else []
    programs.run('plumb-eval', 'placed', *tables, '--config', config, '--boxes', options.boxes, '--classes',
                 ','.join(options.classes), '--json', out / f'{plane}.json', *pictures, log=out / f'{plane}.txt')
    return json.loads((out / f'{plane}.json').read_text())['all']


def parse_options():
    parser = command_line.Parser('eval_objects')
    parser.add_argument('drives', metavar='DRIVE', nargs='+', type=command_line.folder)
    parser.add_argument('--boxes', default='label_02.txt')
    parser.add_argument('--classes', type=command_line.list_of(VEHICLES), default=['car', 'van'])
    parser.add_argument('--planes', type=command_line.list_of(tuple(PLANES)), default=list(PLANES))
    parser.add_argument('--out', type=pathlib.Path, default=OUT / 'objects')
    parser.add_argument('--plots', action='store_true')
    add_bin_option(parser)
    options = parser.parse_args()
    for drive in options.drives:
        for name in ('label_02.txt', options.boxes):
            if not (drive / name).is_file():
                raise UsageError(f'no file {drive / name}')
    return options


def main():
    options = parse_options()
    programs = Programs(options.bin, 'plumb-kitti2lcm', 'plumb-replay', 'plumb-eval')
    logs = convert(options.drives, options.boxes, options.out, programs)
    lines = [TABLE_HEAD]
    for plane in options.planes:
        lines.append(table_row(plane, evaluate(plane, logs, options, programs)))
    text = '\n'.join(lines) + '\n'
    (options.out / 'table.txt').write_text(text)
    print(text, end='')
