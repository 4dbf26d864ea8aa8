#!/usr/bin/python3
"""Tests what tools/can_formats writes against the DBC: KCD and ARXML by canmatrix's readers, the C header
by compiling it and decoding random frames with it, which canmatrix decodes by the DBC."""
import decimal
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
try:
    import canmatrix.formats
except ImportError:
    print('skipped: package python3-canmatrix is not installed')
    sys.exit(77)
import logging  # noqa: E402

logging.disable(logging.WARNING)
ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get('PLUMB_BIN', ROOT / 'build/release/bin'))
FIELDS = ('start_bit', 'size', 'factor', 'offset', 'is_little_endian', 'is_signed', 'values')


def snake(name):
    """The name that cantools gives."""
    name = re.sub(r'(.)([A-Z][a-z]+)', r'\1_\2', name)
    name = re.sub(r'(_+)', '_', name)
    return re.sub(r'([a-z0-9])([A-Z])', r'\1_\2', name).lower()


def member(signal):
    """The member of the C struct; that of an object has no index."""
    return snake(re.sub(r'^Obj\d_', 'Obj_', signal.name))


class CanFormatsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        done = subprocess.run([ROOT / 'tools/can_formats', cls.folder, '--bin', BIN], capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        cls.dbc = canmatrix.formats.loadp_flat(str(ROOT / 'config/plumbline.dbc'))

    def test_dbc_is_the_project_s(self):
        self.assertEqual((self.folder / 'plumbline.dbc').read_text(), (ROOT / 'config/plumbline.dbc').read_text())

    def compare(self, extension, fields, frames):
        other = canmatrix.formats.loadp_flat(str(self.folder / f'plumbline.{extension}'))
        self.assertEqual(len(other.frames), len(frames))
        num_signals = 0
        for frame in frames:
            same = other.frame_by_id(frame.arbitration_id)
            self.assertEqual((same.size, len(same.signals)), (frame.size, len(frame.signals)), frame.name)
            for signal in frame.signals:
                for field in fields:
                    self.assertEqual(getattr(same.signal_by_name(signal.name), field), getattr(signal, field),
                                     f'{signal.name}: {field}')
                num_signals += 1
        return other, num_signals

    def test_kcd_says_all_that_the_dbc_says_of_bits(self):
        kcd, num_signals = self.compare('kcd', (*FIELDS, 'unit', 'min', 'max', 'multiplex'), self.dbc.frames)
        self.assertGreater(num_signals, 200)
        for frame in self.dbc.frames:
            same = kcd.frame_by_id(frame.arbitration_id)
            self.assertEqual((same.name, same.cycle_time), (frame.name, frame.cycle_time))

    def test_arxml_has_the_bits_of_all_frames_without_multiplexing(self):
        plain = [frame for frame in self.dbc.frames if not frame.is_multiplexed]
        self.assertEqual(len(plain), len(self.dbc.frames) - 3)
        arxml, _ = self.compare('arxml', FIELDS, plain)
        for frame in arxml.frames:
            bits = [bit for signal in frame.signals for bit in range(signal.start_bit, signal.start_bit + signal.size)]
            self.assertEqual(len(bits), len(set(bits)), f'{frame.name}: signals lie over one another')

    def program(self):
        """C that prints raw value, physical value and availability of every signal of each frame."""
        lines = []
        for frame in self.dbc.frames:
            prefix = 'plumbline_' + snake(frame.name)
            lines.append(f'  if (id == {prefix.upper()}_FRAME_ID) {{ struct {prefix}_t m; '
                         f'if ({prefix}_unpack(&m, d, 7) != -1 || {prefix}_unpack(&m, d, 8) != 0) return 1;')
            for name in dict.fromkeys(member(signal) for signal in frame.signals):
                call = f'{prefix}_{name}'
                lines.append(f'    printf("{name} %u %.12f %d\\n", (unsigned)m.{name}, {call}_decode(m.{name}), '
                             f'(int){call}_is_in_range(m.{name}));')
            lines.append('    puts("end"); }')
        return '\n'.join(['#include <stdio.h>', '#include "plumbline.h"', 'int main(void) { unsigned id; uint8_t d[8];',
                          ' while (scanf("%x", &id) == 1) {',
                          '  for (int i = 0; i < 8; ++i) { unsigned b; if (scanf("%2x", &b) != 1) return 1; d[i] = (uint8_t)b; }',
                          *lines, ' } return 0; }'])

    def test_c_header_decodes_as_the_dbc(self):
        (self.folder / 'main.c').write_text(self.program())
        for compiler, standard in (('gcc', 'c99'), ('g++', 'c++17')):
            subprocess.run([compiler, f'-std={standard}', *(['-x', 'c++'] if compiler == 'g++' else []), '-Wall', '-Wextra',
                            '-Wpedantic', '-Wconversion', '-Werror', '-Wno-unused-function', self.folder / 'main.c',
                            '-o', self.folder / 'decode'], check=True)
        random.seed(17)
        frames = [(frame, random.randbytes(8)) for frame in self.dbc.frames for _ in range(40)]
        frames += [(frame, bytes(8)) for frame in self.dbc.frames] + [(frame, b'\xff' * 8) for frame in self.dbc.frames]
        text = '\n'.join(f'{frame.arbitration_id.id:x} {data.hex()}' for frame, data in frames)
        done = subprocess.run([self.folder / 'decode'], input=text, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0)
        answers = done.stdout.split('end\n')
        self.assertEqual(len(answers), len(frames) + 1)
        for (frame, data), answer in zip(frames, answers):
            found = {line.split()[0]: line.split()[1:] for line in answer.splitlines()}
            bits = int.from_bytes(data, 'little')
            for signal in frame.signals:
                raw, physical, is_in_range = found[member(signal)]
                expected = bits >> signal.start_bit & (1 << signal.size) - 1
                self.assertEqual(int(raw), expected, signal.name)
                value = expected * signal.factor + signal.offset
                self.assertAlmostEqual(decimal.Decimal(physical), value, places=9)
                self.assertEqual(is_in_range == '1', signal.min <= value <= signal.max, f'{signal.name} {value}')

    def test_c_header_names_ids_values_and_versions(self):
        header = (self.folder / 'plumbline.h').read_text()
        defines = dict(re.findall(r'^#define (\w+) \((\w+)\)$', header, re.M))
        for frame in self.dbc.frames:
            prefix = f'PLUMBLINE_{snake(frame.name).upper()}'
            self.assertEqual(int(defines[f'{prefix}_FRAME_ID'].rstrip('u')), frame.arbitration_id.id)
            self.assertEqual(int(defines[f'{prefix}_CYCLE_TIME_MS'].rstrip('u')), frame.cycle_time)
            self.assertEqual(defines[f'{prefix}_E2E_DATA_ID'].rstrip('u'), str(frame.attributes['E2EDataID']))
            for signal in frame.signals:
                for raw, word in signal.values.items():
                    self.assertEqual(defines[f'{prefix}_{member(signal).upper()}_{word}_CHOICE'], f'{raw}u')
        self.assertEqual(defines['PLUMBLINE_DATABASE_VERSION'], '4u')

    def test_refusals_are_one_sentence(self):
        for arguments, sentence in [([self.folder, '--bin', '/nowhere'], 'no plumb-can'), ([], 'OUT_DIR'),
                                    ([self.folder, '--confg', 'x'], '--config'),
                                    ([self.folder, '--bin', BIN, '--config', '/none.toml'], 'none.toml')]:
            done = subprocess.run([ROOT / 'tools/can_formats', *map(str, arguments)], capture_output=True, text=True)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(sentence, done.stderr)
            self.assertEqual(done.stderr.count('\n'), 1, done.stderr)


if __name__ == '__main__':
    unittest.main()
