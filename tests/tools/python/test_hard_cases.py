"""Tests the figures, bounds and mount frames of tools/evaluate/hard_cases."""
import math
import unittest

import support  # noqa: F401  puts the package on the path
from plumb_tools.command_line import UsageError
from plumb_tools.hard_cases import bounds, mount, rendering
from plumb_tools.hard_cases.measure import ReplayedDrive, percent_longer, rotation_between_rad


def pose(z, yaw_rad=0.0):
    c, s = math.cos(yaw_rad), math.sin(yaw_rad)
    return [c, 0, s, 0, 0, 1, 0, 0, -s, 0, c, z]


def frame(step, status='ok', height='1.65'):
    return {'ego_status': status, 'ego_reason': 'none', 'plane_status': 'ok', 'height_m': height, 'step_m': step,
            'speed_std_m_s': '0.1', 'scale_epoch': '0', 'reset_counter': '2'}


class Figures(unittest.TestCase):
    """Thirty frames at 10 Hz and 10 m/s; the five from 2 s on are wrong by 3 m/s."""

    def setUp(self):
        steps = [1.0] * 30
        steps[20:25] = [1.3] * 5
        frames = [frame('', 'initializing')] + [frame(str(step)) for step in steps[1:]]
        frames[22] = frame('', 'lost', '')
        frames[22]['plane_status'] = 'invalid'
        places = [sum(steps[1:i + 1]) for i in range(30)]
        self.drive = ReplayedDrive(frames, [pose(z) for z in places], [pose(float(i)) for i in range(30)],
                                   dict.fromkeys(range(30), 1.5), [0.1 * i for i in range(30)], [1.95, 2.45])
        self.figures = self.drive.figures()

    def test_counts_statuses_in_the_event_and_outside(self):
        self.assertEqual(self.figures['event_status'], {'ok': 4, 'lost': 1})
        self.assertEqual(self.figures['lost_outside'], 0)
        self.assertEqual(self.figures['start_frames'], 1)
        self.assertEqual(self.figures['resets'], 2)

    def test_compares_heights_with_true_planes(self):
        self.assertAlmostEqual(self.figures['height_mean_percent'], 10.0)
        self.assertEqual(self.figures['height_within_7_percent'], 0.0)

    def test_measures_speed_in_the_event(self):
        self.assertAlmostEqual(self.figures['speed_error_max_m_s'], 3.0)
        self.assertAlmostEqual(self.figures['speed_error_median_m_s'], 3.0)
        self.assertAlmostEqual(self.figures['speed_covered_percent'], 100.0 * 24 / 28)
        self.assertAlmostEqual(self.figures['event_moved_m'], 5.2)

    def test_counts_what_is_right_and_what_is_stated_and_wrong(self):
        self.assertAlmostEqual(self.figures['right_percent'], 50.0)
        self.assertAlmostEqual(self.figures['wrong_percent'], 100.0 * 4 / 30)
        self.assertEqual(self.figures['denied_frames'], 0)

    def test_counts_a_standstill_that_is_said_while_the_car_moves(self):
        self.drive.frames[5] = frame('0.0', 'standstill')
        self.assertEqual(self.drive.figures()['denied_frames'], 1)

    def test_measures_the_recovery_and_the_path(self):
        self.assertEqual(self.figures['recovery_frames'], 0)
        self.assertAlmostEqual(self.figures['path_after_percent'], 0.0)
        self.assertAlmostEqual(self.figures['path_percent'], 100.0 * (30.5 / 29 - 1))


class Geometry(unittest.TestCase):
    def test_angle_between_rotations(self):
        self.assertAlmostEqual(rotation_between_rad(pose(0), pose(5, 0.3)), 0.3)
        self.assertEqual(rotation_between_rad(pose(0), pose(5)), 0.0)

    def test_a_drive_that_hardly_moved_has_no_relative_length(self):
        self.assertTrue(math.isnan(percent_longer(1.0, 0.9)))


class Bounds(unittest.TestCase):
    FIGURES = {'t_percent': 2.5, 'nothing': math.nan, 'event_status': {'lost': 3}, 'event_reason': {'none': 3}}

    def broken(self, **case_bounds):
        return bounds.broken_bounds({'name': 'case', 'bounds': case_bounds}, self.FIGURES)

    def test_are_broken_from_either_side_and_by_nan(self):
        self.assertEqual(self.broken(t_percent_most=2.5, t_percent_least=2.5, event_statuses=['lost']), [])
        self.assertEqual(self.broken(t_percent_most=2.4), ['case: t_percent is 2.5, bound most 2.4'])
        self.assertEqual(len(self.broken(t_percent_least=2.6, nothing_most=9.0)), 2)
        self.assertEqual(self.broken(event_statuses=['ok']), ['case: no frame of the event is ok'])
        self.assertEqual(len(self.broken(event_reasons=['image_dark'])), 1)

    def test_of_an_unknown_figure_are_refused(self):
        for key in ('t_precent_most', 't_percent_max'):
            with self.assertRaisesRegex(UsageError, 'no figure named'):
                self.broken(**{key: 1.0})


class Mount(unittest.TestCase):
    @staticmethod
    def line(time_s, status, pitch_raw):
        raw = status << 12 | pitch_raw << 28 | 2048 << 40 | 0xFFF << 52
        return f'({time_s:.6f}) can0 3A9#{raw.to_bytes(8, "little").hex().upper()}'

    def test_reads_status_and_angles_of_its_frames_alone(self):
        frames = mount.read_trace(['(1.0) can0 3A0#0011', self.line(2.0, mount.STATUS_STEADY, 2048 + 100)])
        self.assertEqual([f.status for f in frames], [mount.STATUS_STEADY])
        self.assertAlmostEqual(frames[0].angles_deg['pitch'], math.degrees(0.02))
        self.assertAlmostEqual(frames[0].angles_deg['roll'], 0.0)
        self.assertTrue(math.isnan(frames[0].angles_deg['yaw']))

    def test_measures_distances_to_the_reference_and_to_the_alarm(self):
        statuses = {1.0: mount.STATUS_UNAVAILABLE, 2.0: mount.STATUS_STEADY, 3.0: mount.STATUS_MOVED,
                    6.0: mount.STATUS_MOVED}
        frames = mount.read_trace([self.line(t, status, 2048) for t, status in statuses.items()])
        figures = mount.measure_mount(frames, 4.0, list(range(8)), [0.0] + [10.0] * 7)
        self.assertEqual(figures['mount_reference_m'], 20.0)
        self.assertEqual(figures['mount_false_alarms'], 1)
        self.assertEqual(figures['mount_moved_m'], -10.0)
        silent = mount.measure_mount([], 4.0, list(range(8)), [10.0] * 8)
        self.assertEqual(silent['mount_moved_m'], math.inf)

    def test_finds_the_knock(self):
        self.assertEqual(mount.knock_time_s('--route stop --knock-at 4.5 --knock-yaw 2'), 4.5)


class Rendering(unittest.TestCase):
    def test_options_of_the_case_replace_the_defaults(self):
        self.assertEqual(rendering.synth_options('--size 620x188 --seed 3', '--seed 4 --flat'),
                         ['--size', '620x188', '--seed', '4', '--flat'])


if __name__ == '__main__':
    unittest.main()
