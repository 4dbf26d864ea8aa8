#!/usr/bin/env python3
"""Tests tools/record and tools/play on the drive that ships with the project, in a private network: what
is recorded and played again gives the CAN frames of the original drive."""
import os
import pathlib
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / 'tools/lib'))
from plumb_tools import private_network  # noqa: E402
from plumb_tools.command_line import UsageError  # noqa: E402
from plumb_tools.live_faults.wire import read_log  # noqa: E402

BIN = pathlib.Path(os.environ.get('PLUMB_BIN', ROOT / 'build/release/bin'))
DRIVE = ROOT / 'tools/run/demo_drive/drive.lcm'
SKIPPED = 77


def events(path):
    """(channel, data) of every event of a log."""
    return ((channel, data) for _, channel, data in read_log(path))


class RecordPlayTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def start(self, name, *command):
        """Starts a process whose output goes to NAME.log; it is ended after the test."""
        with open(self.folder / f'{name}.log', 'w') as log:
            process = subprocess.Popen(list(map(str, command)), stdout=log, stderr=subprocess.STDOUT)
        self.addCleanup(lambda: (process.poll() is None and process.kill(), process.wait()))
        return process

    def said(self, name):
        return (self.folder / f'{name}.log').read_text()

    def wait_until_said(self, name, words):
        end = time.monotonic() + 20
        while words not in self.said(name):
            self.assertLess(time.monotonic(), end, f'{name} never said "{words}": {self.said(name)}')
            time.sleep(0.05)

    def play(self, *arguments, expect=0):
        done = subprocess.run([ROOT / 'tools/play', *map(str, arguments)], capture_output=True, text=True,
                              env={**os.environ, 'PLUMB_PLAY_TIMEOUT_S': '1' if expect else '20'})
        self.assertEqual(done.returncode, expect, done.stderr)
        return done.stderr

    def record(self, *options):
        recorder = self.start('record', BIN / 'plumb-record', self.folder / 'drive.lcm', *options)
        self.wait_until_said('record', 'recording')
        return recorder

    def end(self, recorder, code=0):
        time.sleep(0.5)
        recorder.send_signal(signal.SIGINT)
        self.assertEqual(recorder.wait(20), code, self.said('record'))

    def replay(self, log):
        """The CAN trace that a replay of the log gives."""
        trace = self.folder / f'{log.stem}.can'
        done = subprocess.run([BIN / 'plumb-replay', log, '--can', trace], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        return trace

    def test_recording_of_a_played_drive_is_the_drive(self):
        recorder = self.record()
        self.play(DRIVE, '--all', '--no-wait', '--speed', 6)  # 60 images/s
        self.end(recorder)
        self.assertIn('100 images, 0 lost', self.said('record'))
        # The head of the recording has no other calibration than the drive.
        self.assertEqual(list(events(self.folder / 'drive.lcm')), list(events(DRIVE)))
        recorded = self.replay(self.folder / 'drive.lcm').read_bytes()
        self.assertGreater(len(recorded), 100000)
        (self.folder / 'original.lcm').write_bytes(DRIVE.read_bytes())
        self.assertEqual(recorded, self.replay(self.folder / 'original.lcm').read_bytes())

    def test_recording_played_into_the_chain_gives_the_same_can_frames(self):
        recorder = self.record()
        self.play(DRIVE, '--no-wait', '--speed', 6)
        self.end(recorder)
        self.assertIn('100 images, 0 lost', self.said('record'))
        chain = [self.start(name, BIN / f'plumb-{name}', *options) for name, options in [
            ('can', ['--trace', self.folder / 'live.can']), ('objects', []), ('ground', []), ('vo', [])]]
        # A recording has the times of arrival, so this one plays at the camera's pace at a sixth of its speed.
        self.play(self.folder / 'drive.lcm', '--wait', 'vo,ground,objects,can', '--speed', '0.167')
        time.sleep(1.5)
        for process in chain:
            process.terminate()
        self.assertEqual([process.wait(20) for process in chain], [0, 0, 0, 0])
        compared = subprocess.run([ROOT / 'tools/dev/compare_can', self.folder / 'live.can',
                                   self.replay(self.folder / 'drive.lcm')], capture_output=True, text=True)
        names = ('vo', 'ground', 'objects', 'can')
        if compared.returncode != 0 and any('late 0, skipped 0, unpaired 0' not in self.said(name) for name in names):
            self.skipTest('this machine is too busy for real time: ' + ' '.join(self.said(name) for name in names))
        self.assertEqual(compared.returncode, 0, compared.stdout + compared.stderr)
        self.assertIn('published 100,', self.said('vo'))

    def test_play_sends_only_inputs_unless_told_otherwise(self):
        recorder = self.record('--duration', '60')
        self.play(DRIVE, '--no-wait', '--speed', 20)
        self.end(recorder)
        self.assertEqual({channel for channel, _ in events(self.folder / 'drive.lcm')},
                         {'CAMERA', 'CAMERA_CALIBRATION', 'DETECTIONS'})

    def test_recorder_counts_what_is_missing(self):
        with open(self.folder / 'gap.lcm', 'wb') as gap:
            log, at, num_images = DRIVE.read_bytes(), 0, 0
            while at < len(log):
                _, _, _, name, size = struct.unpack_from('>IqqII', log, at)
                end = at + 28 + name + size
                num_images += log[at + 28:at + 28 + name] == b'CAMERA'
                if not 20 < num_images <= 23:
                    gap.write(log[at:end])
                at = end
        recorder = self.record('--channels', 'CAMERA')
        self.play(self.folder / 'gap.lcm', '--no-wait', '--speed', 20)
        self.end(recorder, code=1)
        self.assertIn('97 images, 3 lost; 97 messages', self.said('record'))

    def test_parts_can_be_replayed(self):
        recorder = self.record('--split-s', '1')
        self.play(DRIVE, '--no-wait', '--speed', 4)
        self.end(recorder)
        parts = sorted(self.folder.glob('drive_*.lcm'))
        self.assertGreaterEqual(len(parts), 3)
        self.assertEqual(sum(channel == 'CAMERA' for part in parts for channel, _ in events(part)), 100)
        for part in parts[:3]:
            self.assertEqual(next(events(part))[0], 'CAMERA_CALIBRATION')
            done = subprocess.run([BIN / 'plumb-replay', part], capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stderr), (0, ''))

    def test_play_says_who_does_not_listen(self):
        self.assertIn('plumb-vo does not listen', self.play(DRIVE, expect=3))

    def test_spy_builds_every_message_or_says_what_is_missing(self):
        done = subprocess.run([ROOT / 'tools/spy', '--build-only'], capture_output=True, text=True)
        if done.returncode == 0:
            self.assertIn(f"{len(list((ROOT / 'lcmtypes').glob('*.lcm')))} messages", done.stdout)
        else:
            self.assertIn('missing Debian packages: apt-get install', done.stderr)
            self.assertEqual((done.returncode, done.stderr.count('\n')), (2, 1))

    def test_refusals_are_one_sentence(self):
        log = self.folder / 'old.lcm'
        log.write_text('old')
        for command, sentence in [
                ([BIN / 'plumb-record', log], 'exists; --force overwrites it'),
                ([BIN / 'plumb-record', self.folder / 'a', '--split-mb', '100', '--keep-mb', '150'], '--keep-mb'),
                ([BIN / 'plumb-record', self.folder / 'no/folder/a', '--duration', '1', '--chanels', 'A'], '--channels'),
                ([ROOT / 'tools/play'], 'give LOG'),
                ([ROOT / 'tools/play', self.folder / 'none'], 'no file'),
                ([ROOT / 'tools/play', log, '--wait', 'vo,gruond'], 'gruond'),
                ([ROOT / 'tools/play', log, '--sped', '2'], '--speed'),
                ([ROOT / 'tools/spy', '--biuld-only'], '--build-only')]:
            done = subprocess.run(list(map(str, command)), capture_output=True, text=True)
            self.assertEqual(done.returncode, 2, command)
            self.assertIn(sentence, done.stderr)
            self.assertEqual(done.stderr.count('\n'), 1, done.stderr)
        self.assertEqual(log.read_text(), 'old')


if __name__ == '__main__':
    try:
        private_network.enter()
    except UsageError as error:
        print('skipped:', error)
        sys.exit(SKIPPED)
    unittest.main()
