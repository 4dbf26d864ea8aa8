"""The command line of tools/evaluate/hard_cases, and the steps from a case to its figures."""
import json
import pathlib
import sys
import tomllib

from plumb_tools import command_line, drive_files, markup
from plumb_tools.hard_cases import bounds, mount
from plumb_tools.hard_cases.measure import ReplayedDrive
from plumb_tools.hard_cases.rendering import render
from plumb_tools.programs import OUT, ROOT, Programs, add_bin_option

TABLES = [ROOT / 'tests/hard_cases' / name for name in ('cases.toml', 'camera_cases.toml', 'road_cases.toml')]


def replay(case, log, folder, programs, user_config):
    """Replays the log with the case's settings, which take precedence over the user's."""
    config = user_config
    if 'config' in case:  # dotted keys must come before any table of the user's file
        config = folder / 'case.toml'
        config.write_text(case['config'] + '\n' + (user_config.read_text() if user_config else ''))
    programs.run('plumb-replay', log, '--poses', folder / 'poses.txt', '--csv', folder / 'replay.csv', '--no-times',
                 '--can', folder / 'replay.can', *(['--config', config] if config else []))


def measure(case, drive, folder, programs):
    """The figures of a case that was replayed."""
    frames = drive_files.read_frames(folder / 'replay.csv')
    replayed = ReplayedDrive(
        frames, drive_files.read_poses(folder / 'poses.txt'), drive_files.read_poses(drive / 'poses.txt'),
        drive_files.read_plane_heights(drive / 'gt_ground_plane.txt'),
        [row[0] for row in drive_files.read_rows(drive / 'times.txt')], case.get('event_s'))
    figures = replayed.figures()
    if '--knock-at' in case['synth']:
        times = [1e-6 * int(frame['utime']) for frame in frames]
        trace = mount.read_trace((folder / 'replay.can').read_text().splitlines())
        knock_s = times[0] + mount.knock_time_s(case['synth'])
        figures.update(mount.measure_mount(trace, knock_s, times, replayed.true_steps))
    if sum(replayed.true_steps) > 12.0:  # two segments of 10 m
        programs.run('plumb-eval', drive / 'poses.txt', folder / 'poses.txt', '--lengths', '10,20,50', '--step', 5,
                     '--json', folder / 'eval.json')
        entry = json.loads((folder / 'eval.json').read_text())['sequences'][0]
        figures.update(t_percent=entry['t_percent'], r_deg_m=entry['r_deg_m'])
    return figures


def parse_options(known):
    parser = command_line.Parser('hard_cases')
    parser.add_argument('cases', metavar='CASE', nargs='*', type=command_line.one_of(known))
    parser.add_argument('--out', type=pathlib.Path, default=OUT / 'hard')
    parser.add_argument('--config', type=command_line.file)
    for flag in ('--check', '--reuse', '--list'):
        parser.add_argument(flag, action='store_true')
    add_bin_option(parser)
    return parser.parse_args()


def main():
    tables = [tomllib.loads(path.read_text()) for path in TABLES]
    defaults = tables[0]['defaults']
    cases = {case['name']: case for table in tables for case in table['case']}
    options = parse_options(tuple(cases))
    if options.list:
        print('\n'.join(f"{case['name']:<24} {case['what']}" for case in cases.values()))
        return 0
    programs = Programs(options.bin, 'plumb-synth', 'plumb-kitti2lcm', 'plumb-replay', 'plumb-eval')
    rows, broken = [], []
    for name in options.cases or cases:
        case, folder = cases[name], options.out / name
        drive, log = render(case, defaults, folder, programs, options.reuse)
        replay(case, log, folder, programs, options.config)
        figures = measure(case, drive, folder, programs)
        (folder / 'result.json').write_text(json.dumps(figures, indent=1))
        rows.append(bounds.table_row(case, figures))
        broken += bounds.broken_bounds(case, figures)
        print(f'{name}: done', file=sys.stderr)
    text = '\n'.join(markup.markdown_table(bounds.COLUMNS, rows)) + '\n'
    if not options.cases:
        (options.out / 'table.md').write_text(text)
    print(text, end='')
    for sentence in broken:
        print('broken: ' + sentence)
    return 1 if options.check and broken else 0
