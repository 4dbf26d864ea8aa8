"""Tests that shell scripts refuse wrong options before they install, build or start anything."""
import unittest

import support

SCRIPTS = ('demo', 'dev/compare_can', 'dev/tidy', 'live', 'test')


class EveryScript(support.FolderTest):
    def test_prints_its_head_as_help(self):
        for script in SCRIPTS:
            code, out, err = self.run_script(script, '--help')
            self.assertEqual((code, err), (0, ''), script)
            self.assertIn('tools/' + script, out)
            self.assertNotIn('#', out)

    def test_names_the_nearest_option(self):
        for script in SCRIPTS:
            self.assert_refused(script, ['--hlep'], 'unknown option --hlep; did you mean --help?')
            self.assert_refused(script, ['--frobnicate'], 'unknown option --frobnicate; see --help')


class Values(support.FolderTest):
    def test_that_are_missing_or_wrong_are_refused(self):
        log = self.write('drive.lcm', 'log')
        out = self.folder / 'out'
        cases = (
            ('live', [log], 'give LOG and OUT_DIR'),
            ('live', [log, out, '--speed'], '--speed wants a value'),
            ('live', [log, out, '--speed', 'abc'], '--speed abc is not a number above zero'),
            ('live', [log, out, '--speed', '0.0'], '--speed 0.0 is not a number above zero'),
            ('live', [log, out, '--config', 'none.toml'], 'no file none.toml'),
            ('live', [log, out, '--preset', 'none'], 'build first'),
            ('live', [log, log], 'is not a folder'),
            ('live', [log, out, 'third'], 'unexpected argument third'),
            ('live', [self.folder / 'none.lcm', out], 'no file'),
            ('demo', ['--frames', 'many'], '--frames many is not a whole number of 20 or more'),
            ('demo', ['--frames', '19'], '--frames 19 is not'),
            ('demo', ['--route'], '--route wants a value'),
            ('demo', ['--kitti', 'none'], 'no folder none'),
            ('demo', ['--kitti', self.folder, '--render'], '--kitti goes without --render'),
            ('demo', ['--out', log], 'is not a folder'),
            ('demo', ['drive.lcm'], 'unexpected argument drive.lcm'),
            ('test', ['tidy'], 'unexpected argument tidy'),
            ('dev/compare_can', [log], 'give two traces'),
            ('dev/compare_can', [log, 'none.can'], 'no file none.can'))
        for script, arguments, sentence in cases:
            self.assert_refused(script, arguments, sentence)
        self.assertFalse(out.exists())

    def test_a_log_among_the_outputs_is_refused_and_kept(self):
        for name in ('health.lcm', 'live.can'):
            log = self.write(f'out/{name}', 'recorded')
            before = log.read_bytes(), log.stat().st_ino
            self.assert_refused('live', [log, self.folder / 'out'], 'would overwrite the input')
            self.assertEqual((log.read_bytes(), log.stat().st_ino), before)


class CompareCan(support.FolderTest):
    """Two frames of PLB_Ego with the same value, the second with another alive counter."""

    FRAMES = '(1.000000) can0 3A0#010{}AABBCCDD\n(1.010000) can0 3A0#021{}AABBCCDD\n'

    def test_leaves_the_alive_counter_aside(self):
        a = self.write('a.can', self.FRAMES.format('0', '0'))
        b = self.write('b.can', self.FRAMES.format('0', '0').replace('#01', '#07'))
        self.assertEqual(self.run_script('dev/compare_can', a, b)[0], 0)
        b.write_text(self.FRAMES.format('0', '0').replace('DD', 'DE'))
        code, out, _ = self.run_script('dev/compare_can', a, b)
        self.assertEqual(code, 1)
        self.assertIn('live differs from replay', out)


if __name__ == '__main__':
    unittest.main()
