"""The command line of tools/evaluate/live_faults, and the steps of a case."""
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

from plumb_tools import command_line, private_network, programs
from plumb_tools.command_line import UsageError
from plumb_tools.live_faults import wire
from plumb_tools.live_faults.can_trace import Dbc
from plumb_tools.live_faults.cases import all_cases
from plumb_tools.live_faults.chain import NAMES, Chain
from plumb_tools.live_faults.judge import Drive, capture_times, judge
from plumb_tools.markup import markdown_table

HEAD = ['kind', 'fault', 'what happens', 'valid frames', 'older than 250 ms while valid', 'oldest',
        'wrong while valid', 'worst error', 'time to detect', 'time to recover', 'counted']
MOST_GROWTH_MB = 2.0
SETTLED_S = 3.0  # estimators have been created by then
INPUTS = 'CAMERA|CAMERA_CALIBRATION|DETECTIONS'
RESULTS = ('VO_MOTION', 'GROUND_PLANE', 'EGO_MOTION', 'OBJECTS')


class Run:
    """One case while its log plays."""

    def __init__(self, case, chain, drive, log):
        self.case, self.chain, self.drive = case, chain, drive
        self.begin_s = self.end_s = math.inf
        self.start_s = time.time()
        self.play(log, '|'.join((INPUTS, *RESULTS)) if case.plays_recording else INPUTS)

    def play(self, log, channels=INPUTS):
        self.player = self.chain.play(log, channels)

    def wait_until(self, seconds):
        """Waits until so many seconds after the log began to play."""
        time.sleep(max(0.0, self.start_s + seconds - time.time()))

    def begin(self):
        self.begin_s = time.time()

    def signal(self, name, number):
        if name == 'camera':
            self.player.send_signal(number)
        else:
            self.chain.signal(name, number)

    def finish(self):
        """Lets the fault happen and the log play to its end."""
        self.case.run(self)
        self.end_s = time.time()
        self.player.wait()
        time.sleep(0.7)  # for the last health messages


def run_case(case, options, types, dbc, drive, log):
    """Runs one case. Returns (cells of the table, whether the bars hold, what was heard)."""
    folder = options.out / case.name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    with Chain(options.programs, types, folder, case) as chain:
        run = Run(case, chain, drive, log)
        run.finish()
    frames = sorted((frame for trace in chain.traces if trace.exists()
                     for frame in dbc.read(trace, 'PLB_EgoMotion')), key=lambda frame: frame[0])
    end_s = run.end_s
    if case.calibrates:  # it listens when it says so
        end_s = first_after(first_after(end_s, chain.health(case.calibrates)),
                            chain.listener.messages['CAMERA_CALIBRATION'])
    verdict = judge(frames, chain.listener.images, drive, run.begin_s, end_s)
    counts = chain.counts()
    said = [f'{name} ' + ', '.join(f'{word} {number}' for word, number in words.items())
            for name, words in counts.items() if words] + chain.not_ended
    growth_mb = chain.growth_mb(max(run.begin_s, run.start_s + SETTLED_S))
    if growth_mb > MOST_GROWTH_MB:
        said.append(f'memory grew by {growth_mb:.0f} MB')
    is_counted = all(word in counts[name] for name, word in case.counts)
    kept = verdict.is_kept() and is_counted and not chain.not_ended
    return row(case, verdict, '; '.join(said) or '-'), kept, chain.listener


def first_after(time_s, messages):
    """When the first of the messages after that time arrived."""
    return min((arrival_s for arrival_s, _ in messages if arrival_s > time_s), default=math.inf)


def row(case, verdict, counted):
    """The cells of HEAD."""
    def seconds(value, otherwise='never'):
        return f'{value:.2f} s' if math.isfinite(value) else otherwise
    share = verdict.num_wrong / max(verdict.num_valid, 1)
    error = f'{verdict.worst_error_m_s:.1f} m/s' if math.isfinite(verdict.worst_error_m_s) else 'not known'
    return [case.kind, case.name, case.what, f'{verdict.num_valid} of {verdict.num_frames}', str(verdict.num_old),
            seconds(verdict.worst_age_s, 'not known'), f'{verdict.num_wrong} ({100 * share:.1f} %)', error,
            seconds(verdict.detect_s), seconds(verdict.recover_s), counted]


def make_types(folder):
    """Lets lcm-gen write the messages as Python classes. Returns their package."""
    messages = sorted(map(str, (programs.ROOT / 'lcmtypes').glob('*.lcm')))
    done = subprocess.run(['lcm-gen', '-p', '--ppath', str(folder), *messages], capture_output=True, text=True)
    if done.returncode != 0:
        raise UsageError(f'lcm-gen failed: {done.stderr.strip()}')
    sys.path.insert(0, str(folder))
    import plumb
    return plumb


def with_results(log, listener, path):
    """Writes the log with the results that were heard while it played, each at its time."""
    _, stamp_us, capture_s = capture_times(listener.images)[0]
    offset_us = int(1e6 * capture_s) - stamp_us
    results = [(int(1e6 * arrival_s) - offset_us, channel, data) for channel in RESULTS
               for arrival_s, data in listener.messages[channel]]
    wire.write_log(path, sorted([*wire.read_log(log), *results], key=lambda event: event[0]))
    return path


def parse(cases):
    parser = command_line.Parser('live_faults')
    parser.add_argument('log', metavar='LOG', type=command_line.file)
    parser.add_argument('--case', type=command_line.list_of(cases), default=None)
    parser.add_argument('--out', type=pathlib.Path, default=programs.OUT / 'live_faults')
    programs.add_bin_option(parser)
    options = parser.parse_args()
    options.programs = programs.Programs(options.bin, *(f'plumb-{name}' for name in NAMES))
    return options


def main():
    cases = all_cases()
    options = parse(cases)
    private_network.enter()
    kept = True
    recorded = None
    with tempfile.TemporaryDirectory() as folder:
        types = make_types(pathlib.Path(folder))
        drive = Drive(options.log, types)
        dbc = Dbc(options.programs.run('plumb-can', '--print-dbc'))
        print('\n'.join(markdown_table(HEAD, [])), flush=True)
        for name in options.case or cases:
            case, log = cases[name], options.log
            if case.needs_s > drive.duration_s + 0.2:
                print(f'{name}: {options.log} is shorter than {case.needs_s:.1f} s, passed over', file=sys.stderr)
                continue
            if case.plays_recording:
                if recorded is None:
                    recorded = run_case(cases['sound'], options, types, dbc, drive, log)[2]
                log = with_results(log, recorded, pathlib.Path(folder) / 'recording.lcm')
            cells, holds, heard = run_case(case, options, types, dbc, drive, log)
            if name == 'sound':
                recorded = heard
            kept = kept and holds
            print('| ' + ' | '.join(cells) + ' |', flush=True)
    return 0 if kept else 1
