#!/usr/bin/env python3
"""Tests the examples: what they print of a log and of live messages is what was sent."""
import math
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
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
        with open(cls.log, 'wb') as file:
            for number, (channel, data) in enumerate(events):
                file.write(struct.pack('>IqqII', 0xEDA1DA01, number, 25000 * number, len(channel), len(data)))
                file.write(channel.encode() + data)

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
    if 'PLUMB_EXAMPLES_TEST_INSIDE' not in os.environ:
        flags = ['--net'] if os.getuid() == 0 else ['--net', '--map-root-user']
        if subprocess.run(['unshare', *flags, 'true'], stderr=subprocess.DEVNULL).returncode != 0:
            print('skipped: a private network namespace is not permitted here (unshare -n)')
            sys.exit(SKIPPED)
        os.environ['PLUMB_EXAMPLES_TEST_INSIDE'] = '1'
        os.execvp('unshare', ['unshare', *flags, sys.executable, *sys.argv])
    subprocess.run(['ip', 'link', 'set', 'lo', 'up', 'multicast', 'on'], check=True)
    subprocess.run(['ip', 'route', 'add', '224.0.0.0/4', 'dev', 'lo'], check=True)
    unittest.main()
