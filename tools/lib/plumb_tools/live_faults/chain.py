"""Runs the live processes for one case, and keeps what they say."""
import fcntl
import os
import signal
import subprocess
import time

from plumb_tools.command_line import UsageError
from plumb_tools.live_faults import wire

NAMES = ('can', 'objects', 'ground', 'vo')
START_S, STOP_S = 20.0, 5.0
COUNTERS = {'num_rejected': 'rejected', 'num_dropped': 'lost', 'num_late': 'late', 'num_skipped': 'skipped',
            'num_unpaired': 'unpaired', 'num_unsent': 'unsent'}


def _full_pipe():
    """The writing end of a pipe that is full and that nobody reads. Returns (both ends)."""
    reading, writing = os.pipe()
    flags = fcntl.fcntl(writing, fcntl.F_GETFL)
    fcntl.fcntl(writing, fcntl.F_SETFL, flags | os.O_NONBLOCK)
    try:
        while True:
            os.write(writing, b'.' * 4096)
    except BlockingIOError:
        pass
    fcntl.fcntl(writing, fcntl.F_SETFL, flags)
    return reading, writing


class Chain:
    """The processes of one run. Use it in a with statement."""

    def __init__(self, programs, types, folder, case):
        self.programs, self.types, self.folder, self.case = programs, types, folder, case
        self.source_port = wire.PORT if case.change is None else wire.PORT + 1
        self.processes, self.traces, self.not_ended, self.open_ends = {}, [], [], []
        self.players = []

    def __enter__(self):
        self.listener = wire.Listener()
        self.relay = None
        if self.case.change is not None:
            self.relay = wire.Relay(self.source_port, wire.PORT, self.case.change())
        for name in NAMES:
            if name not in self.case.without:
                self.start(name)
        self.wait_until_heard([name for name in NAMES if name not in self.case.without])
        return self

    def __exit__(self, *_):
        for player in self.players:
            player.kill()
            player.wait()
        for name in list(self.processes):
            self.end(name)
        for end in self.open_ends:
            os.close(end)
        if self.relay:
            self.relay.end()
        self.listener.end()

    def start(self, name, key=None):
        """Starts a process; `key` names a second one of the same kind."""
        port = self.source_port if name == 'vo' else wire.PORT
        words = [self.programs.path(f'plumb-{name}'), '--lcm-url', wire.url(port)]
        if name == 'can':
            self.traces.append(self.folder / f'live_{len(self.traces)}.can')
            words += ['--trace', self.traces[-1]]
        if name == self.case.deaf:
            reading, error = _full_pipe()
            self.open_ends += [reading, error]
        else:
            error = open(self.folder / f'{key or name}.log', 'ab')
        self.processes[key or name] = subprocess.Popen([str(word) for word in words], stderr=error,
                                                       stdout=subprocess.DEVNULL)

    def wait_until_heard(self, names):
        """Waits until each of the processes has published its health since now."""
        heard = {name: len(self.health(name)) for name in names}
        until = time.time() + START_S
        while any(len(self.health(name)) <= count for name, count in heard.items()):
            if time.time() > until:
                raise UsageError(f'a process did not start within {START_S:.0f} s; see {self.folder}')
            time.sleep(0.02)

    def health(self, name):
        """[(arrival in s, encoded process_health_t)], oldest first."""
        return self.listener.messages[f'HEALTH_{name.upper()}']

    def signal(self, name, number):
        self.processes[name].send_signal(number)

    def kill(self, name):
        self.processes[name].kill()
        self.processes.pop(name).wait()

    def end(self, name):
        """Asks a process to end, and kills it when it does not."""
        process = self.processes.pop(name)
        process.send_signal(signal.SIGCONT)
        process.terminate()
        try:
            code = process.wait(STOP_S)
            if code != 0:
                self.not_ended.append(f'{name} ended with {code}')
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
            self.not_ended.append(f'{name} ignored SIGTERM')

    def play(self, log, channels):
        """Starts lcm-logplayer and returns it."""
        player = subprocess.Popen(['lcm-logplayer', '-e', channels, '-l', wire.url(self.source_port), str(log)],
                                  stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.players.append(player)
        return player

    def counts(self):
        """What the processes counted: {process: {counter: number}}, without zeros."""
        counts = {}
        for name in NAMES:
            most = dict.fromkeys(COUNTERS.values(), 0)
            for _, data in self.health(name):  # a process that was restarted counts anew
                health = self.types.process_health_t.decode(data)
                for field, word in COUNTERS.items():
                    most[word] = max(most[word], getattr(health, field))
            counts[name] = {word: number for word, number in most.items() if number}
        return counts

    def growth_mb(self, since_s):
        """The largest growth of a process's memory over its last report before that time, in MB."""
        growth = 0.0
        for name in set(NAMES) - set(self.case.without):
            before, after = [], []
            for arrival_s, data in self.health(name):
                report = self.types.process_health_t.decode(data)
                (before if arrival_s < since_s else after).append(report.memory_rss_bytes * 1e-6)
            if before and after:
                growth = max(growth, max(after) - before[-1])
        return growth
