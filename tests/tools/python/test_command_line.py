"""Tests that a wrong command line gives one sentence and exit code 2."""
import os
import unittest

import support
from plumb_tools import command_line
from plumb_tools.command_line import UsageError

SCRIPTS = ('eval_real', 'evaluate/ablations', 'evaluate/bench_accuracy', 'evaluate/eval_objects',
           'evaluate/hard_cases', 'evaluate/height_error', 'evaluate/report', 'learn/render_drives',
           'learn/train_model')


class EveryScript(support.FolderTest):
    def test_prints_its_docstring_as_help(self):
        for script in SCRIPTS:
            code, out, err = self.run_script(script, '--help')
            self.assertEqual((code, err), (0, ''), script)
            self.assertIn('tools/' + script, out)

    def test_refuses_an_unknown_option(self):
        for script in SCRIPTS:
            self.assert_refused(script, ['--frobnicate'], 'unknown option --frobnicate; see --help')

    def test_refuses_to_go_without_its_arguments(self):
        for script in SCRIPTS:
            if script != 'evaluate/hard_cases':  # which then takes every case
                self.assert_refused(script, [], 'is missing; see --help')

    def test_names_the_nearest_option(self):
        for script in SCRIPTS:
            if script not in ('evaluate/ablations', 'evaluate/height_error', 'evaluate/report'):
                self.assert_refused(script, ['--bni', '.'], 'unknown option --bni; did you mean --bin?')


class Values(support.FolderTest):
    def test_that_are_missing_or_wrong_are_refused(self):
        drives = self.folder
        cases = (
            ('evaluate/bench_accuracy', [drives, '--seeds'], '--seeds wants a value'),
            ('evaluate/bench_accuracy', [drives, '--seeds', 'two'], '--seeds: two is not a whole number'),
            ('evaluate/bench_accuracy', [drives, '--jobs', '0'], '--jobs: 0 is below 1'),
            ('evaluate/bench_accuracy', [drives, '--modes', 'defualt'], 'did you mean default?'),
            ('evaluate/bench_accuracy', [drives, '--modes', 'a=none.toml'], 'no file none.toml'),
            ('evaluate/bench_accuracy', [drives / 'none'], 'is not a folder'),
            ('evaluate/bench_accuracy', [drives, drives], 'unexpected argument'),
            ('evaluate/hard_cases', ['plian'], 'plian is none of the'),
            ('evaluate/hard_cases', ['plian'], 'did you mean plain?'),
            ('evaluate/eval_objects', [drives, '--planes', 'our'], 'did you mean ours?'),
            ('evaluate/eval_objects', [drives], 'no file'),
            ('evaluate/height_error', ['a.txt', 'b.csv'], 'POSES: no file a.txt'),
            ('learn/render_drives', ['none.txt', '--out', drives], 'no file none.txt'),
            ('eval_real', [drives, '--seed', '-1'], '--seed'),
            ('eval_real', [drives, '--bin', drives], 'build first'))
        for script, arguments, sentence in cases:
            self.assert_refused(script, arguments, sentence)


class RefuseOverwriting(support.FolderTest):
    def setUp(self):
        super().setUp()
        self.log = self.write('log.lcm', 'log')

    def refuse(self, output):
        with self.assertRaisesRegex(UsageError, 'would overwrite LOG'):
            command_line.refuse_overwriting({'LOG': self.log}, {'--csv': output})

    def test_an_input_by_any_path(self):
        self.refuse(self.log)
        os.link(self.log, self.folder / 'hard')
        self.refuse(self.folder / 'hard')
        os.symlink('log.lcm', self.folder / 'soft')
        self.refuse(self.folder / 'soft')

    def test_the_same_output_twice_even_before_it_exists(self):
        new = self.folder / 'new.txt'
        os.symlink('new.txt', self.folder / 'dangling')
        for other in (new, self.folder / '.' / 'new.txt', self.folder / 'dangling'):
            with self.assertRaisesRegex(UsageError, '--csv .* would overwrite --poses'):
                command_line.refuse_overwriting({}, {'--poses': new, '--csv': other})

    def test_but_not_devices_or_other_files(self):
        command_line.refuse_overwriting({'LOG': self.log, '--config': None},
                                        {'--csv': '/dev/null', '--poses': '/dev/null', '--can': None})
        command_line.refuse_overwriting({'LOG': self.log}, {'--csv': self.folder / 'new.csv'})

    def test_leaves_the_input_as_it_was(self):
        pose = ' '.join(['0'] * 12)
        poses = self.write('poses.txt', f'{pose}\n')
        frames = self.write('frames.csv', 'seq,vo_status,log_scale\n0,ok,0\n')
        before = frames.read_bytes(), frames.stat().st_ino
        self.assert_refused('evaluate/height_error', [poses, frames, '--json', frames], 'would overwrite CSV')
        self.assertEqual((frames.read_bytes(), frames.stat().st_ino), before)


if __name__ == '__main__':
    unittest.main()
