"""Tests finding, rendering, training on and evaluating drives, with stand-ins for the programs."""
import unittest

import support
from plumb_tools import eval_objects, eval_real, programs, render_drives
from plumb_tools.command_line import UsageError


class FindDrives(support.FolderTest):
    def test_takes_both_layouts_and_passes_over_drives_without_poses(self):
        for name in ('b/image_0/0.png', 'b/poses.txt', 'a/image_00/data/0.png', 'a/poses.txt', 'c/image_0/0.png'):
            self.write(name, '')
        self.assertEqual(list(programs.find_drives(self.folder)), ['a', 'b'])

    def test_refuses_two_of_one_name_and_none_at_all(self):
        with self.assertRaisesRegex(UsageError, 'no drive'):
            programs.find_drives(self.folder)
        for name in ('x/a/image_0/0.png', 'x/a/poses.txt', 'y/a/image_0/0.png', 'y/a/poses.txt'):
            self.write(name, '')
        with self.assertRaisesRegex(UsageError, 'two drives are named a'):
            programs.find_drives(self.folder / 'x', self.folder / 'y')


class RunningPrograms(support.FolderTest):
    def test_a_failure_is_told_in_its_last_line(self):
        self.fake_program('plumb-replay', 'echo first >&2; echo "why it failed" >&2; exit 2')
        runner = programs.Programs(self.folder / 'bin', 'plumb-replay')
        with self.assertRaisesRegex(UsageError, 'plumb-replay failed with 2: why it failed'):
            runner.run('plumb-replay')
        self.assertFalse(runner.succeeds('plumb-replay'))

    def test_output_goes_to_the_log(self):
        self.fake_program('plumb-eval', 'echo "$@"')
        out = programs.Programs(self.folder / 'bin').run('plumb-eval', 1, 'b', log=self.folder / 'log.txt')
        self.assertEqual(out, '1 b\n')
        self.assertEqual((self.folder / 'log.txt').read_text(), out)


class RenderDrives(support.FolderTest):
    def setUp(self):
        super().setUp()
        self.list = self.write('list.txt', '# comment\none  --route city --seed 1\ntwo --poses POSES/02.txt\n')
        self.fake_program('plumb-synth', 'mkdir -p "$2" && echo "$@" >> "$2/calls.txt"')

    def render(self, *names):
        return self.run_script('learn/render_drives', self.list, *names, '--out', self.folder / 'out', '--bin',
                               self.folder / 'bin', '--poses', self.folder)

    def test_renders_once_until_the_options_change(self):
        self.assertEqual(self.render('one')[0], 0)
        self.assertEqual(self.render('one')[0], 0)
        calls = self.folder / 'out/one/calls.txt'
        self.assertEqual(len(calls.read_text().splitlines()), 1)
        self.list.write_text('one --route city --seed 2\n')
        self.assertEqual(self.render('one')[0], 0)
        self.assertEqual(len(calls.read_text().splitlines()), 2)

    def test_refuses_unknown_names_and_missing_poses(self):
        code, _, err = self.render('oen')
        self.assertEqual((code, 'did you mean one?' in err), (2, True))
        code, _, err = self.render()
        self.assertEqual((code, 'two: no file' in err), (2, True))
        self.assertFalse((self.folder / 'out').exists(), 'nothing is rendered before the list is known to be sound')

    def test_replaces_the_folder_of_poses(self):
        poses = self.write('02.txt', '')
        words = render_drives.synth_options('two', '--poses POSES/02.txt', self.folder)
        self.assertEqual(words, ['--poses', str(poses)])
        with self.assertRaisesRegex(UsageError, '--poses is missing'):
            render_drives.synth_options('two', '--poses POSES/02.txt', None)


class TrainModel(support.FolderTest):
    def test_runs_three_rounds_and_the_papers(self):
        for name in ('drives/a/image_0/0.png', 'drives/a/poses.txt'):
            self.write(name, '')
        record = f'echo "$@" >> {self.folder}/calls.txt; while [ $# -gt 0 ]; do [ "$1" != --out ] || : > "$2"; shift; done'
        for name in ('plumb-kitti2lcm', 'plumb-train'):
            self.fake_program(name, record)
        out = self.folder / 'out'
        code, _, err = self.run_script('learn/train_model', self.folder / 'drives', '--out', out, '--bin',
                                       self.folder / 'bin', '--paper', '--hold-out', 'a')
        self.assertEqual(code, 0, err)
        calls = (self.folder / 'calls.txt').read_text().splitlines()
        self.assertEqual([call.split()[0] for call in calls[1:]], ['sample', 'fit'] * 4)
        self.assertIn('--plane-only', calls[6])
        self.assertTrue(all('--hold-out a' in call for call in calls if call.startswith('fit')))
        self.assertTrue((out / 'model.toml').exists())
        self.assertFalse((out / 'paper_model.toml').exists())

    def test_refuses_an_unknown_drive_to_hold_out(self):
        for name in ('a/image_0/0.png', 'a/poses.txt'):
            self.write(name, '')
        self.assert_refused('learn/train_model', [self.folder, '--hold-out', 'b'], 'no drive b')


class Tables(unittest.TestCase):
    REPLAY = ('log: 51 frames, 30.5 frames/s on one thread, 12.3 ms of processor time each\n'
              'frames by status\n  ego    50 ok, 1 initializing\n'
              '  total      51   6.10   9.20   9.90\n  total      51   7.30   8.40   8.80\n')

    def test_summary_of_a_replay(self):
        self.assertEqual(eval_real.summary_of(self.REPLAY),
                         ' 6.10  9.20 |  7.30  8.40 |  12.3 |   30.5 | 50 ok, 1 initializing')

    def test_row_of_a_plane(self):
        errors = {'num_samples': 5, 'foot_depth_error_percent': 7.25, 'depth_error_percent': 3.5,
                  'depth_error_median_percent': None, 'depth_nees': 1.0}
        row = eval_objects.table_row('ours', {'num_placed': 3, 'num_labels': 4, 'close': {'all': errors},
                                              'distant': {'all': errors}})
        self.assertTrue(row.startswith('ours               75% |     5    7.2    3.5      -   1.00 |'), row)


class Report(support.FolderTest):
    def test_shows_what_is_there(self):
        self.write('eval.txt', 'a < b')
        self.write('plots/p.png', '')
        self.write('live/vo.log', 'started')
        self.write('replay.can', 'frame\n' * 100)
        code, _, err = self.run_script('evaluate/report', self.folder)
        self.assertEqual(code, 0, err)
        page = (self.folder / 'report.html').read_text()
        for part in ('a &lt; b', '<img src="plots/p.png"', 'Process vo', 'CAN trace'):
            self.assertIn(part, page)
        self.assertNotIn('Ground plane', page)
        self.assertEqual(page.count('frame\n') + page.count('frame</pre>'), 24)


if __name__ == '__main__':
    unittest.main()
