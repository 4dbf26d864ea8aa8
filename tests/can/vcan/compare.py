#!/usr/bin/python3
"""Compares the signal values that two candump logs carry for every camera frame.

    compare.py DBC LIVE REFERENCE

canmatrix, an independent implementation, decodes the frames through the DBC. The comparison omits
alive counters, CRCs, ages, the start of counters, cyclic repeats, and values that were "not
available" because there was no input. Code of this file checks the counters and CRCs of the live frames. The script prints what it
compared, and exits with 1 when anything differs.
"""
import collections
import re
import sys

import canmatrix.formats

MOUNT = 'PLB_Mount'  # compared by its changes, because it belongs to no camera frame
OBJECTS = 'PLB_Object'  # lists; a newer one replaces those that still wait
MOST_PASSED_OVER = 0.05
LINE = re.compile(r'\((\d+\.\d+)\) \S+ ([0-9A-F]{3})#([0-9A-F]{16})$')


def crc_e2e_11a(data, data_id):
    crc = 0
    for byte in [data_id & 0xFF, data_id >> 8, *data[1:]]:
        crc ^= byte
        for _ in range(8):
            crc = ((crc << 1) ^ 0x1D) & 0xFF if crc & 0x80 else crc << 1
    return crc


class Trace:
    """The frames of one log, as decoded values by message and camera frame, in order."""

    def __init__(self, path, database):
        self.database = database
        self.frames = collections.defaultdict(list)  # message name -> [(FrameCtr, {signal: value})]
        self.times = collections.defaultdict(list)
        self.counters = collections.defaultdict(list)
        self.errors = []
        self.last_absent = {}
        for number, line in enumerate(open(path), 1):
            match = LINE.match(line.strip())
            if match is None:
                self.errors.append(f'{path}:{number}: not a frame of 8 bytes: {line.strip()}')
                continue
            self.take(f'{path}:{number}', float(match[1]), int(match[2], 16), bytes.fromhex(match[3]))

    def take(self, where, time, identifier, data):
        frame = self.database.frame_by_id(canmatrix.ArbitrationId(identifier, extended=False))
        if frame is None:
            self.errors.append(f'{where}: identifier {identifier:X} is not in the DBC')
            return
        if crc_e2e_11a(data, int(frame.attribute('E2EDataID'))) != data[0]:
            self.errors.append(f'{where}: wrong CRC')
        self.times[frame.name].append(time)
        self.counters[frame.name].append(data[1] & 0x0F)
        values = {}
        absent = False
        counter = 0 if frame.name == MOUNT else None
        for name, decoded in frame.decode(data).items():
            if name.endswith(('_Crc', '_AliveCtr', '_Age', '_StartCtr', '_ResetCtr')):
                continue
            if name.endswith('_FrameCtr'):
                counter = int(decoded.raw_value)
                continue
            is_na = decoded.signal.values.get(decoded.raw_value) == 'SNA'
            values[name] = 'SNA' if is_na else float(decoded.phys_value)
            says_absence = name.endswith(('_Validity', 'Detail_Status', 'Mount_Status', 'List_Count', 'Frame_SpeedDoubt'))
            absent = absent or (is_na and says_absence)
            if says_absence:
                self.last_absent[frame.name] = absent
        if counter is None or absent:
            return
        known = self.frames[frame.name]
        if not known or known[-1] != (counter, values):
            known.append((counter, values))

    def check_counters(self):
        for name, counters in self.counters.items():
            for before, after in zip(counters, counters[1:]):
                if after != (before + 1) % 15:
                    self.errors.append(f'{name}: alive counter went from {before} to {after}')

    def check_cycles(self):
        for name, times in self.times.items():
            # The cycle is 0 for messages that are sent with the list of objects.
            cycle = float(self.database.frame_by_name(name).cycle_time) * 1e-3
            mean = (times[-1] - times[0]) / max(len(times) - 1, 1)
            gap = max((b - a for a, b in zip(times, times[1:])), default=0.0)
            print(f'  {name:22} {len(times):6} frames, every {mean * 1e3:7.2f} ms, longest gap {gap * 1e3:7.2f} ms')
            # A user-mode kernel on a busy machine loses ticks. Other tests check the exact cycles.
            # The mount's messages come faster than its cycle.
            least = 0.0 if name == MOUNT else 0.4 * cycle
            if cycle > 0.0 and len(times) > 10 and not least < mean < 2.0 * cycle:
                self.errors.append(f'{name}: sent every {mean * 1e3:.1f} ms, not every {cycle * 1e3:.0f} ms')


def without_passed_over(name, got, expected, problems):
    """The expected objects that the live log has, too.

    A stalled machine omits a list when a newer one is there already.
    """
    kept = []
    for entry in expected:
        if len(kept) < len(got) and got[len(kept)] == entry:
            kept.append(entry)
    num_missing = len(expected) - len(kept)
    if num_missing > MOST_PASSED_OVER * len(expected):
        problems.append(f'{name}: {num_missing} of {len(expected)} are missing or differ')
    if num_missing > 0:
        print(f'  {name}: {num_missing} of {len(expected)} passed over')
    return kept


def compare(live, reference):
    problems = []
    num_frames = num_values = 0
    for name, expected in reference.frames.items():
        got = live.frames[name]
        if name.startswith(OBJECTS):
            expected = without_passed_over(name, got, expected, problems)
        if len(got) != len(expected):
            problems.append(f'{name}: {len(got)} camera frames live, {len(expected)} in the reference')
        for (got_counter, got_values), (counter, values) in zip(got, expected):
            if got_counter != counter:
                problems.append(f'{name}: frame counter {got_counter} live, {counter} in the reference')
                break
            for signal, value in values.items():
                if got_values[signal] != value:
                    problems.append(f'{signal}, frame counter {counter}: {got_values[signal]} live, {value} in the reference')
            num_frames += 1
            num_values += len(values)
    return problems, num_frames, num_values


def main():
    database = canmatrix.formats.loadp_flat(sys.argv[1])
    live, reference = Trace(sys.argv[2], database), Trace(sys.argv[3], database)
    live.check_counters()
    live.check_cycles()
    problems, num_frames, num_values = compare(live, reference)
    problems += live.errors + reference.errors
    if num_frames == 0:
        problems.append('nothing to compare')
    for name, absent in live.last_absent.items():
        if name in reference.frames and not absent:
            problems.append(f'{name}: still available after the input ended')
    for problem in problems[:20]:
        print(problem)
    frames = sorted({len(list_) for name, list_ in reference.frames.items() if name != MOUNT})
    print(f'{num_values} signal values of {num_frames} messages ({frames} camera frames) compared, {len(problems)} problems')
    return 1 if problems else 0


sys.exit(main())
