"""Tests tools/evaluate/height_error, which compares heights with the true step length."""
import json
import unittest

import support

HEAD = ('seq,vo_status,scale_epoch,vo_t_x,vo_t_y,vo_t_z,plane_status,log_scale,dense_status,dense_height_vo,'
        'points_status,points_height_vo')
FIRST_ROW = '0,initializing,0,0,0,0,initializing,,absent,,absent,'
ROW = '%d,ok,0,0,0,0.5,ok,0.673344553,used,0.84,failed,0.5'


class HeightError(support.FolderTest):
    """Ten frames of 1 m in which VO's unit is 2 m.

    The filter's height is 1.65 m x 1.02, the dense cue's is 0.84 units.
    """

    def setUp(self):
        super().setUp()
        self.poses = self.write('poses.txt', ''.join(f'1 0 0 0 0 1 0 0 0 0 1 {k}\n' for k in range(10)))
        rows = [HEAD, FIRST_ROW] + [ROW % k for k in range(1, 10)]
        self.frames = self.write('drive.csv', '\n'.join(rows) + '\n')

    def run_tool(self, *options):
        code, out, err = self.run_script('evaluate/height_error', self.poses, self.frames, *options)
        self.assertEqual(code, 0, err)
        return out

    def test_compares_with_the_nominal_height_by_the_true_step(self):
        out = self.run_tool('--json', self.folder / 'errors.json')
        self.assertIn('fused       9 frames  mean   2.00 %  bias   2.00 %', out)
        self.assertIn('dense       9 frames  mean   1.82 %', out)
        self.assertIn('points      0 frames', out)
        errors = json.loads((self.folder / 'errors.json').read_text())
        self.assertEqual(len(errors['fused']['errors_percent']), 9)
        self.assertAlmostEqual(errors['fused']['within_7_percent_ratio'], 1.0)

    def test_prefers_measured_planes(self):
        planes = self.write('planes.txt', '# frame nx ny nz height_m\n' +
                            ''.join(f'{k} 0 1 0 1.4\n' for k in range(10)))
        out = self.run_tool('--planes', planes)
        self.assertIn('dense       9 frames  mean  20.00 %  bias  20.00 %  within 7 %:   0', out)

    def test_refuses_what_does_not_belong_together(self):
        self.poses.write_text('1 0 0 0 0 1 0 0 0 0 1 0\n')
        files = [self.poses, self.frames]
        self.assert_refused('evaluate/height_error', files, 'has 10 frames')
        self.poses.write_text('1 0 0\n')
        self.assert_refused('evaluate/height_error', files, 'poses.txt:1: fewer than 12 numbers')
        self.poses.write_text('1 0 zero\n')
        self.assert_refused('evaluate/height_error', files, 'poses.txt:1: not a row of numbers')
        self.poses.write_text(' '.join(['0'] * 12))
        self.frames.write_text('a,b\n1,2\n')
        self.assert_refused('evaluate/height_error', files, 'not a table of plumb-replay --csv')


if __name__ == '__main__':
    unittest.main()
