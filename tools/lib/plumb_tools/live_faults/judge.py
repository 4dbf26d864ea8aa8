"""Compares what was sent on CAN with the drive's truth and with the time at which it was captured."""
import math
from bisect import bisect_right
from collections import defaultdict
from dataclasses import dataclass

from plumb_tools.command_line import UsageError
from plumb_tools.live_faults.wire import read_log, stamp_of

OLDEST_VALID_S = 0.25
WRONG_STDS, WRONG_M_S = 3.0, 0.3
VALID = 2  # EgoMotion_Validity
MOST_WRONG = 0.005
SLOWEST_RECOVERY_S = 1.5


class Drive:
    """The images of a log by their stamps: sequence number and true speed."""

    def __init__(self, path, types):
        self.path = path
        self.stamps = []
        truth = []
        for _, channel, data in read_log(path):
            if channel == 'CAMERA':
                self.stamps.append(stamp_of(data))
            elif channel == 'GROUND_TRUTH':
                truth.append(types.ground_truth_t.decode(data))
        if len(truth) < 2 or not all(pose.has_pose for pose in truth):
            raise UsageError(f'{path} has no true poses (GROUND_TRUTH)')
        self.number = {pose.utime: pose.seq for pose in truth}
        self.speed = {}
        for before, pose in zip(truth, truth[1:]):
            way = math.dist(before.t_world_cam_m, pose.t_world_cam_m)
            self.speed[pose.utime] = way / (pose.utime - before.utime) * 1e6
        self.speed[truth[0].utime] = self.speed[truth[1].utime]

    @property
    def duration_s(self):
        return (self.stamps[-1] - self.stamps[0]) * 1e-6


def capture_times(images):
    """[(time of arrival, stamp, true time of capture)] in the order of arrival.

    A source sends an image soonest when nothing holds it up, so the smallest lag of its stamps is
    the offset of its clock. A stamp that goes back begins another pass of the log.
    """
    passes = defaultdict(list)
    number, newest = defaultdict(int), {}
    for image in images:
        if image.stamp_us < newest.get(image.source, image.stamp_us):
            number[image.source] += 1
        newest[image.source] = image.stamp_us
        passes[image.source, number[image.source]].append(image)
    known = []
    for group in passes.values():
        offset_s = min(image.arrival_s - image.stamp_us * 1e-6 for image in group)
        known += [(image.arrival_s, image.stamp_us, image.stamp_us * 1e-6 + offset_s) for image in group]
    return sorted(known)


@dataclass
class Verdict:
    """What the frames of a run say."""
    num_frames: int = 0
    num_valid: int = 0
    num_old: int = 0
    num_wrong: int = 0
    worst_age_s: float = 0.0
    worst_error_m_s: float = 0.0
    detect_s: float = 0.0        # from the begin of the fault to the last frame within it that is old or wrong
    recover_s: float = math.inf  # from its end to the first valid frame of a later image that is neither

    def is_kept(self):
        """Whether the bars hold."""
        return (self.num_old == 0 and self.num_wrong <= MOST_WRONG * max(self.num_valid, 1)
                and self.recover_s <= SLOWEST_RECOVERY_S)


class Content:
    """Finds the image that a frame shows by the low byte of its number."""

    def __init__(self, drive, images):
        self.by_byte = defaultdict(list)
        for arrival_s, stamp_us, capture_s in capture_times(images):
            if stamp_us in drive.number:
                self.by_byte[drive.number[stamp_us] & 0xFF].append((arrival_s, stamp_us, capture_s))

    def find(self, low_byte, time_s):
        """(stamp, time of capture) of the newest such image that had been sent; None without one."""
        sent = self.by_byte.get(low_byte, [])
        at = bisect_right(sent, (time_s, math.inf, math.inf))
        return sent[at - 1][1:] if at else None


def judge(frames, images, drive, begin_s, end_s):
    """Judges frames of PLB_EgoMotion, (time in s, signals) in the order of time.

    The fault lasted from begin_s to end_s in the time of the frames.
    """
    content = Content(drive, images)
    verdict = Verdict()
    for time_s, signals in frames:
        verdict.num_frames += 1
        if signals['EgoMotion_Validity'] != VALID:
            continue
        verdict.num_valid += 1
        shown = content.find(int(signals['EgoMotion_FrameCtr'] or 0), time_s)
        age_s = time_s - shown[1] if shown else math.inf
        speed, std = signals['EgoMotion_Speed'], signals['EgoMotion_SpeedStd']
        known = shown and speed is not None and std is not None
        error = abs(speed - drive.speed[shown[0]]) if known else math.inf
        is_old = age_s > OLDEST_VALID_S
        is_wrong = error > max(WRONG_STDS * (std or 0.0), WRONG_M_S)
        verdict.num_old += is_old
        verdict.num_wrong += is_wrong
        verdict.worst_age_s = max(verdict.worst_age_s, age_s)
        verdict.worst_error_m_s = max(verdict.worst_error_m_s, error)
        if (is_old or is_wrong) and begin_s <= time_s <= end_s:
            verdict.detect_s = time_s - begin_s
        if not is_old and not is_wrong and shown[1] >= end_s:
            verdict.recover_s = min(verdict.recover_s, time_s - end_s)
    return verdict
