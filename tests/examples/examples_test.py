#!/usr/bin/env python3
"""Tests the examples: what they print of a log and of live messages is what was sent."""
import math
import os
import pathlib
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
from plumb_tools.live_faults.wire import write_log  # noqa: E402

SKIPPED = 77
NUM_MOTIONS = 20


class ExamplesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        types = sorted(map(str, (ROOT / 'lcmtypes').glob('*.lcm')))
        subprocess.run(['lcm-gen', '-p', '--ppath', cls.folder, *types], check=True)
        for command in (['cmake', '-S', ROOT / 'examples/cpp', '-B', cls.folder / 'build', '-DCMAKE_BUILD_TYPE=Debug'],
                        ['cmake', '--build', cls.folder / 'build']):
            subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        sys.path.insert(0, str(cls.folder))
        cls.log = cls.folder / 'motions.lcm'
        cls.write_log()
        cls.commands = {'python': ([sys.executable, ROOT / 'examples/python/speed.py'], str(cls.log)),
                        'cpp': ([cls.folder / 'build/speed'], f'file://{cls.log}?speed=0')}

    @classmethod
    def write_log(cls):
        """A log of motions whose speed changes; the first two are not valid. Other channels lie between."""
        from plumb import ego_motion_t
        events, cls.expected = [], ''
        for i in range(NUM_MOTIONS):
            motion = ego_motion_t()
            motion.utime = 1000000 + 100000 * i
            motion.status = motion.STATUS_INITIALIZING if i < 2 else motion.STATUS_OK
            motion.velocity_ground_m_s = [10.0 + math.sin(i), 0.1, 0.0]
            motion.speed_std_m_s = 0.05 * i
            events += [('MOUNT', b'not for us'), ('EGO_MOTION', motion.encode())]
            if i >= 2:
                cls.expected += f'{1 + 0.1 * i:.3f} s: {10 + math.sin(i):.2f} +- {0.05 * i:.2f} m/s\n'
        write_log(cls.log, ((25000 * number, *event) for number, event in enumerate(events)))

    def environment(self):
        return {**os.environ, 'PYTHONPATH': str(self.folder), 'PYTHONDONTWRITEBYTECODE': '1'}

    def test_from_a_log(self):
        for language, (command, source) in self.commands.items():
            done = subprocess.run([*command, source], capture_output=True, text=True, env=self.environment(), timeout=20)
            self.assertEqual(done.stdout, self.expected, language + done.stderr)

    def test_live(self):
        processes = {language: subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                                                env=self.environment()) for language, (command, _) in self.commands.items()}
        for process in processes.values():
            self.addCleanup(lambda process=process: (process.kill(), process.communicate()))
        time.sleep(2.0)  # until they listen
        subprocess.run(['lcm-logplayer', '-l', 'udpm://239.255.76.67:7667?ttl=0', self.log], check=True,
                       stdout=subprocess.DEVNULL)
        time.sleep(0.5)
        for language, process in processes.items():
            process.terminate()
            self.assertEqual(process.communicate(timeout=10)[0], self.expected, language)


if __name__ == '__main__':
    try:
        private_network.enter()
    except UsageError as error:
        print('skipped:', error)
        sys.exit(SKIPPED)
    unittest.main()
