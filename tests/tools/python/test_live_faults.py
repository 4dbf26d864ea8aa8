"""Tests what tools/evaluate/live_faults judges by: packets, logs, traces, captures, verdicts."""
import math
import struct
import unittest

import support
from plumb_tools.command_line import UsageError
from plumb_tools.live_faults import cases, wire
from plumb_tools.live_faults.can_trace import Dbc
from plumb_tools.live_faults.judge import Verdict, capture_times, judge
from plumb_tools.live_faults.wire import SentImage

DBC = '''BO_ 928 PLB_EgoMotion: 8 PLB
 SG_ EgoMotion_Validity : 12|2@1+ (1,0) [0|2] "" Receiver
 SG_ EgoMotion_FrameCtr : 16|8@1+ (1,0) [0|255] "" Receiver
 SG_ EgoMotion_Speed : 24|16@1- (0.5,-10) [-100|227.67] "m/s" Receiver

BO_ 929 PLB_EgoMotionDetail: 8 PLB
 SG_ EgoDetail_Status : 12|4@1+ (1,0) [0|14] "" Receiver
'''


class Wire(support.FolderTest):
    def test_a_log_is_read_as_it_was_written(self):
        events = [(5, 'CAMERA', b'abc'), (7, 'VO_MOTION', b'')]
        wire.write_log(self.folder / 'a.lcm', events)
        self.assertEqual(list(wire.read_log(self.folder / 'a.lcm')), events)

    def test_what_is_no_log_is_refused(self):
        path = self.write('a.lcm', 'twenty-eight bytes of no log at all')
        with self.assertRaisesRegex(UsageError, 'is no LCM log'):
            list(wire.read_log(path))

    def test_the_channel_stands_in_short_packets_and_in_first_fragments(self):
        short = struct.pack('>4sI', b'LC02', 1) + b'VO_MOTION\0data'
        self.assertEqual(wire.split_packet(short), ('VO_MOTION', b'data'))
        for number, expected in ((0, ('CAMERA', b'data')), (1, (None, b''))):
            fragment = struct.pack('>4sIIIHH', b'LC03', 1, 900, 0, number, 2) + b'CAMERA\0data'
            self.assertEqual(wire.split_packet(fragment), expected)
        self.assertEqual(wire.split_packet(b'junk'), (None, b''))

    def test_one_motion_is_dropped_or_swapped_with_the_next_one(self):
        def packet(number):
            return struct.pack('>4sI', b'LC02', number) + b'VO_MOTION\0'
        other = struct.pack('>4sI', b'LC02', 9) + b'CAMERA\0'
        numbers = range(1, 51)
        for name, expected in (('dropped', [*range(1, 40), *range(41, 51)]),
                               ('swapped', [*range(1, 40), 41, 40, *range(42, 51)])):
            change = cases._change_motion(name)
            carried = [struct.unpack('>I', out[4:8])[0] for number in numbers for out in change(packet(number))]
            self.assertEqual(carried, expected)
            self.assertEqual(change(other), [other])


class Trace(support.FolderTest):
    def test_values_are_those_of_the_signals(self):
        trace = self.write('live.can', '\n'.join((
            '(12.500000) can0 3A0#0020050400000000',
            '(12.510000) can0 3A1#0000000000000000',
            '(12.520000) can0 3A0#00FFFFFFFF000000',
            '(12.530000) can0 3A0#0020FFFEFF000000',
            '(12.540000) can0 3A')))
        self.assertEqual(list(Dbc(DBC).read(trace, 'PLB_EgoMotion')), [
            (12.5, {'EgoMotion_Validity': 2, 'EgoMotion_FrameCtr': 5, 'EgoMotion_Speed': -8.0}),
            (12.52, {'EgoMotion_Validity': None, 'EgoMotion_FrameCtr': None, 'EgoMotion_Speed': None}),
            (12.53, {'EgoMotion_Validity': 2, 'EgoMotion_FrameCtr': None, 'EgoMotion_Speed': -11.0})])

    def test_an_unknown_message_is_refused(self):
        with self.assertRaisesRegex(UsageError, 'no message PLB_Other'):
            list(Dbc(DBC).read('none.can', 'PLB_Other'))


class Captures(unittest.TestCase):
    def test_the_smallest_lag_is_the_offset_of_a_pass(self):
        sent = [SentImage(100.3, 0, 1), SentImage(100.11, 100_000, 1), SentImage(100.22, 200_000, 1),
                SentImage(150.0, 0, 1), SentImage(100.15, 100_000, 2)]
        captured = [round(capture_s, 6) for _, _, capture_s in capture_times(sent)]
        self.assertEqual(captured, [100.11, 100.15, 100.21, 100.01, 150.0])


class FakeDrive:
    """A drive at 10 images/s whose speed is 8 m/s."""
    number = {100_000 * i: 250 + i for i in range(20)}
    speed = {stamp: 8.0 for stamp in number}


class Verdicts(unittest.TestCase):
    def verdict_of(self, *frames, begin=0.0, end=0.0):
        images = [SentImage(50.0 + stamp * 1e-6, stamp, 1) for stamp in FakeDrive.number]
        said = [(50.0 + time_s, {'EgoMotion_Validity': validity, 'EgoMotion_FrameCtr': low_byte,
                                 'EgoMotion_Speed': speed, 'EgoMotion_SpeedStd': std})
                for time_s, validity, low_byte, speed, std in frames]
        return judge(said, images, FakeDrive, 50.0 + begin, 50.0 + end)

    def test_sound_frames_keep_the_bars(self):
        verdict = self.verdict_of((0.01, 2, 250, 8.1, 0.02), (0.7, 2, 1, 8.0, 0.02), (1.9, 1, 250, 0.0, 0.0))
        self.assertEqual((verdict.num_frames, verdict.num_valid, verdict.num_old, verdict.num_wrong), (3, 2, 0, 0))
        self.assertAlmostEqual(verdict.recover_s, 0.01)
        self.assertAlmostEqual(self.verdict_of((0.3, 2, 252, 8.0, 0.1), (0.35, 2, 253, 8.0, 0.1), end=0.3).recover_s,
                               0.05, msg='image 252 was captured before the end')
        self.assertTrue(verdict.is_kept())

    def test_an_old_image_counts_while_valid_alone(self):
        verdict = self.verdict_of((0.3, 2, 250, 8.0, 0.1), (0.4, 3, None, None, None), begin=0.1, end=0.5)
        self.assertEqual((verdict.num_valid, verdict.num_old), (1, 1))
        self.assertAlmostEqual(verdict.worst_age_s, 0.3)
        self.assertAlmostEqual(verdict.detect_s, 0.2)
        self.assertEqual(verdict.recover_s, math.inf)
        self.assertFalse(verdict.is_kept())

    def test_a_speed_is_wrong_beyond_three_standard_deviations_and_the_least_error(self):
        for speed, std, is_wrong in ((8.29, 0.0, 0), (8.4, 0.1, 1), (8.4, 0.14, 0), (None, 0.1, 1), (8.0, None, 1)):
            self.assertEqual(self.verdict_of((0.1, 2, 251, speed, std)).num_wrong, is_wrong, (speed, std))

    def test_a_frame_of_no_image_that_was_sent_is_old_and_wrong(self):
        verdict = self.verdict_of((0.1, 2, 9, 8.0, 0.1))
        self.assertEqual((verdict.num_old, verdict.num_wrong), (1, 1))

    def test_bars(self):
        self.assertTrue(Verdict(num_valid=1000, num_wrong=5, recover_s=1.5).is_kept())
        self.assertFalse(Verdict(num_valid=1000, num_wrong=6, recover_s=1.5).is_kept())
        self.assertFalse(Verdict(num_valid=1000, recover_s=1.6).is_kept())
        self.assertFalse(Verdict(num_valid=1000).is_kept())


class CommandLine(support.FolderTest):
    def test_wrong_words_are_refused(self):
        log = self.write('drive.lcm', 'log')
        bin_dir = [f'--bin={self.folder}']
        self.assert_refused('evaluate/live_faults', [log, '--case', 'vo_slow'], 'vo_slow is none of')
        self.assert_refused('evaluate/live_faults', [self.folder / 'none.lcm'], 'no file')
        self.assert_refused('evaluate/live_faults', [log, *bin_dir], 'build first')


if __name__ == '__main__':
    unittest.main()
