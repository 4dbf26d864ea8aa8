"""The command line of tools/evaluate/bench_accuracy."""
import concurrent.futures
import os
import pathlib
import sys

from plumb_tools import command_line
from plumb_tools.accuracy import report
from plumb_tools.accuracy.bench import MODES, Bench
from plumb_tools.command_line import UsageError
from plumb_tools.programs import OUT, Counter, Programs, add_bin_option, find_drives


def parse_modes(text):
    """{name: configuration} of 'NAME,NAME=FILE.toml'. Raises UsageError."""
    modes = {}
    for word in text.split(','):
        name, has_file, path = word.partition('=')
        if has_file:
            modes[name] = command_line.file(path).read_text()
        else:
            modes[name] = MODES[command_line.one_of(tuple(MODES))(name)]
    return modes


def parse_options():
    parser = command_line.Parser('bench_accuracy')
    parser.add_argument('drives', metavar='DRIVES_DIR', type=command_line.folder)
    parser.add_argument('--modes', type=parse_modes, default=dict(MODES))
    parser.add_argument('--seeds', type=command_line.at_least(1), default=1)
    parser.add_argument('--out', type=pathlib.Path, default=OUT / 'accuracy')
    parser.add_argument('--jobs', type=command_line.at_least(1), default=os.cpu_count())
    add_bin_option(parser)
    return parser.parse_args()


def run_all(bench, num_jobs):
    """Converts every drive, then replays and evaluates every run, several at a time."""
    jobs = [(mode, seed, drive) for drive in bench.drives for mode in bench.modes for seed in bench.seeds]
    counter = Counter(len(jobs), 'runs')
    with concurrent.futures.ThreadPoolExecutor(num_jobs) as pool:
        list(pool.map(bench.convert, bench.drives))
        for _ in pool.map(bench.measure, jobs):
            counter.step()


def main():
    options = parse_options()
    programs = Programs(options.bin, 'plumb-kitti2lcm', 'plumb-replay', 'plumb-eval', 'plumb-train')
    if options.out.exists() and not options.out.is_dir():
        raise UsageError(f'--out {options.out} is not a folder')
    bench = Bench(programs, options.out, find_drives(options.drives), options.modes, options.seeds)
    run_all(bench, options.jobs)
    # Paths say nothing elsewhere: the report names the folders alone.
    words = [word if word.startswith('--') or os.sep not in word else os.path.basename(word.rstrip(os.sep))
             for word in sys.argv[1:]]
    print('\n'.join(report.write(bench, 'tools/evaluate/bench_accuracy ' + ' '.join(words))))
    print(f'wrote report.md and report.html in {options.out}')
