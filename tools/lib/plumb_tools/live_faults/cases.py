"""The faults that are put into the live processes, one row of the table each."""
import signal
import time
from dataclasses import dataclass
from functools import partial
from typing import Callable, Optional

from plumb_tools.live_faults import wire

BEGIN_S = 4.0  # the chain is valid by then
SLOW_S = 3.0
RUNNING_S = 0.004
SOUND_S = 2.5  # of sound input after a fault, so that its end can be judged
SKIPS = {'vo': (('vo', 'skipped'),), 'ground': (('ground', 'skipped'), ('ground', 'unpaired'))}


@dataclass(frozen=True)
class Case:
    """A fault. `run` is called when the log begins to play and returns when the fault has ended."""
    name: str
    kind: str  # of docs/faults.md
    what: str
    run: Callable  # (run of the case) -> None
    needs_s: float = BEGIN_S + SOUND_S  # length of the log
    without: tuple = ()  # processes that are not there from the beginning
    deaf: Optional[str] = None  # the process whose stderr nobody reads
    change: Optional[Callable] = None  # makes the function of a wire.Relay between camera and vo, and the rest
    calibrates: Optional[str] = None  # the process whose recovery counts from the calibration that it hears
    plays_recording: bool = False
    counts: tuple = ()  # (process, counter) that must say so


def _begin(run):
    run.begin()


def _sound(run):
    run.wait_until(BEGIN_S)
    run.begin()


def _stop(name, duration_s, run):
    run.wait_until(BEGIN_S)
    run.begin()
    run.signal(name, signal.SIGSTOP)
    time.sleep(duration_s)
    run.signal(name, signal.SIGCONT)


def _slow(name, stopped_s, run):
    run.wait_until(BEGIN_S)
    run.begin()
    end = time.time() + SLOW_S
    while time.time() < end:
        run.signal(name, signal.SIGSTOP)
        time.sleep(stopped_s)
        run.signal(name, signal.SIGCONT)
        time.sleep(RUNNING_S)


def _kill(name, run):
    run.wait_until(BEGIN_S)
    run.begin()
    run.chain.kill(name)
    time.sleep(1.0)
    run.chain.start(name)


def _start_late(name, run):
    run.begin()
    run.wait_until(BEGIN_S)
    run.chain.start(name)


def _refuse_much(run):
    """Makes every process write to stderr."""
    run.wait_until(BEGIN_S)
    run.begin()
    sender = wire.Sender()
    for _ in range(30):
        for channel in ('CAMERA_CALIBRATION', 'GROUND_PLANE', 'DETECTIONS'):
            sender.publish(channel, b'no message')
        time.sleep(0.1)


def _second_camera(run):
    run.wait_until(BEGIN_S)
    run.begin()
    player = run.chain.play(run.drive.path, 'CAMERA')
    time.sleep(3.0)
    player.kill()


def _second_vo(run):
    run.wait_until(BEGIN_S)
    run.begin()
    run.chain.start('vo', 'vo_2')
    time.sleep(3.0)
    run.chain.kill('vo_2')


def _play_again(run):
    run.wait_until(run.drive.duration_s + 0.2)
    run.begin()
    run.play(run.drive.path)


def _change_motion(name):
    """A function for wire.Relay that drops one VO_MOTION, or swaps it with the next one."""
    held, count = [], [0]

    def change(packet):
        channel, _ = wire.split_packet(packet)
        if channel != 'VO_MOTION':
            return [packet]
        count[0] += 1
        if count[0] == int(BEGIN_S * 10):
            held.append(packet)
            return []
        if held and name == 'swapped':
            return [packet, held.pop()]
        return [packet]
    return change


def _stops():
    for name in ('vo', 'ground', 'can', 'objects', 'camera'):
        for seconds in (0.5, 3, 10):
            yield Case(f'{name}_stopped_{seconds}s', 'A', f'{name} stands still for {seconds} s',
                       partial(_stop, name, seconds), BEGIN_S + seconds + SOUND_S,
                       counts=SKIPS[name] if name in SKIPS else ())


def _restarts():
    for name in ('vo', 'ground', 'can', 'objects'):
        yield Case(f'{name}_restarted', 'J', f'{name} is killed, and started again after 1 s', partial(_kill, name),
                   BEGIN_S + 2.0 + SOUND_S, calibrates=name if name in ('vo', 'ground') else None)
    for name in ('vo', 'ground'):
        yield Case(f'{name}_late', 'J', f'{name} is started {BEGIN_S:.0f} s after the camera',
                   partial(_start_late, name), BEGIN_S + 1.0 + SOUND_S, without=(name,), calibrates=name)


def _slows():
    for name in ('vo', 'ground'):
        for stopped_s in (0.05, 0.15, 0.3):
            yield Case(f'{name}_slow_{1000 * stopped_s:.0f}ms', 'A',
                       f'{name} runs for {1000 * RUNNING_S:.0f} ms and stands still for {1000 * stopped_s:.0f} ms, '
                       f'for {SLOW_S:.0f} s', partial(_slow, name, stopped_s), BEGIN_S + SLOW_S + SOUND_S,
                       counts=SKIPS[name] if stopped_s > 0.1 else ())


def all_cases():
    """{name: Case} in the order of the table."""
    cases = [Case('sound', '-', 'nothing', _begin, needs_s=2.0)]
    cases += [*_slows(), *_stops(), *_restarts()]
    cases += [Case(f'{name}_unread', 'K', f"a full pipe that nobody reads is {name}'s stderr", _refuse_much,
                   BEGIN_S + 3.0 + SOUND_S, deaf=name) for name in ('vo', 'ground', 'can')]
    cases += [
        Case('motion_dropped', 'F', 'one VO_MOTION does not reach ground', _sound,
             change=partial(_change_motion, 'dropped'), counts=(('ground', 'lost'),)),
        Case('motion_swapped', 'F', 'two neighbouring VO_MOTION come in the wrong order', _sound,
             change=partial(_change_motion, 'swapped'), counts=(('ground', 'lost'),)),
        Case('two_cameras', 'J', 'the log is played a second time, 4 s later, for 3 s', _second_camera,
             BEGIN_S + 3.0 + SOUND_S),
        Case('two_vo', 'J', 'a second plumb-vo runs for 3 s', _second_vo, BEGIN_S + 3.0 + SOUND_S),
        Case('recording_played', 'J', 'the log holds the results of an earlier run, too', _sound,
             plays_recording=True),
        Case('played_twice', 'C', 'the log is played a second time when it has ended', _play_again)]
    return {case.name: case for case in cases}
