"""Reads candump traces with the signals of a DBC file."""
import re
from dataclasses import dataclass

from plumb_tools.command_line import UsageError

_MESSAGE = re.compile(r'BO_ (\d+) (\w+):')
_SIGNAL = re.compile(r' SG_ (\w+) : (\d+)\|(\d+)@1([+-]) \(([^,]+),([^)]+)\)')
_FRAME = re.compile(r'\((\d+\.\d+)\) \S+ ([0-9A-F]+)#([0-9A-F]*)$')


@dataclass(frozen=True)
class Signal:
    """A little-endian signal. All ones mean that its value is not available."""
    start: int
    length: int
    is_signed: bool
    factor: float
    offset: float

    def value(self, bits):
        """The physical value; None when it is not available."""
        raw = bits >> self.start & (1 << self.length) - 1
        if raw == (1 << self.length) - 1:
            return None
        if self.is_signed and raw >> self.length - 1:
            raw -= 1 << self.length
        return raw * self.factor + self.offset


class Dbc:
    """The signals that are not multiplexed, by message and name."""

    def __init__(self, text):
        self.identifiers, self.signals = {}, {}
        message = None
        for line in text.splitlines():
            if begin := _MESSAGE.match(line):
                message = begin[2]
                self.identifiers[message] = int(begin[1])
                self.signals[message] = {}
            elif message and (found := _SIGNAL.match(line)):
                self.signals[message][found[1]] = Signal(
                    int(found[2]), int(found[3]), found[4] == '-', float(found[5]), float(found[6]))

    def read(self, path, message):
        """Yields (time in s, {signal: value}) of every frame of that message in a trace."""
        if message not in self.identifiers:
            raise UsageError(f'the DBC has no message {message}')
        with open(path) as trace:
            for line in trace:
                frame = _FRAME.match(line.rstrip())
                if not frame or int(frame[2], 16) != self.identifiers[message]:
                    continue  # a process that was killed leaves a cut line
                bits = int.from_bytes(bytes.fromhex(frame[3]), 'little')
                yield float(frame[1]), {name: signal.value(bits) for name, signal in self.signals[message].items()}
