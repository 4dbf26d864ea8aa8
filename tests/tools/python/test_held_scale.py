"""Tests tools/evaluate/held_scale, which keeps one scale for a whole drive."""
import math
import unittest

import support


class HeldScale(support.FolderTest):
    """Steps of 1 m along z; the scale grows by 1 % with every frame after the tenth."""

    def write_drive(self, num_frames):
        self.poses = self.write('poses.txt', ''.join(f'1 0 0 0 0 1 0 0 0 0 1 {k}\n' for k in range(num_frames)))
        rows = ['seq,vo_status,ego_status,log_scale', '0,ok,initializing,0']
        rows += [f'{k},ok,ok,{0.5 + 0.01 * max(0, k - 10)}' for k in range(1, num_frames)]
        self.frames = self.write('drive.csv', '\n'.join(rows) + '\n')

    def test_undoes_what_the_scale_did_after_the_start(self):
        self.write_drive(30)
        out = self.folder / 'held.txt'
        code, _, err = self.run_script('evaluate/held_scale', self.poses, self.frames, out)
        self.assertEqual(code, 0, err)
        places = [float(line.split()[11]) for line in out.read_text().splitlines()]
        self.assertEqual(len(places), 30)
        self.assertAlmostEqual(places[10], 10.0, places=6)
        self.assertAlmostEqual(places[29] - places[28], math.exp(-0.19), places=6)

    def test_refuses_a_drive_without_a_beginning(self):
        self.write_drive(8)
        code, _, err = self.run_script('evaluate/held_scale', self.poses, self.frames, self.folder / 'held.txt')
        self.assertEqual(code, 2)
        self.assertIn('fewer than 10', err)

    def test_refuses_to_overwrite_the_poses(self):
        self.write_drive(30)
        code, _, _ = self.run_script('evaluate/held_scale', self.poses, self.frames, self.poses)
        self.assertEqual(code, 2)


if __name__ == '__main__':
    unittest.main()
