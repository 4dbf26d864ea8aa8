"""Figures of a replayed drive against its truth."""
import collections
import functools
import math

from plumb_tools.drive_files import number, positions
from plumb_tools.figures import quantile

START_FRAMES = 15  # until a scale can be expected
SETTLED_FRAMES = 10  # a recovered speed stays right for as long
SPEED_BOUND_RATIO, SPEED_BOUND_M_S = 0.05, 0.3  # a speed is right within the larger of both
START_S = 2.0  # of a drive, in which nothing need be valid
MOVING_M_S = 0.5  # faster than this nobody stands


def rotation_between_rad(a, b):
    """Angle between the rotations of two pose rows."""
    trace = sum(a[4 * i + k] * b[4 * i + k] for i in range(3) for k in range(3))
    return math.acos(max(-1.0, min(1.0, 0.5 * (trace - 1.0))))


def steps_of(places):
    """Distance to each place from the one before it; 0 for the first."""
    return [0.0] + [math.dist(a, b) for a, b in zip(places, places[1:])]


def percent_longer(path, true_path):
    """By how much the path is longer than the true one; NaN for a drive that hardly moved."""
    return 100.0 * (path / true_path - 1.0) if true_path > 1.0 else math.nan


class ReplayedDrive:
    """A drive's truth and what plumb-replay made of it, frame by frame.

    `frames` are rows of plumb-replay's table, `planes` true heights by frame. `event_s` is the
    (first, last) second of the hard part; None stands for the whole drive.
    """

    def __init__(self, frames, poses, true_poses, planes, times, event_s=None):
        self.frames, self.poses, self.true_poses, self.planes = frames, poses, true_poses, planes
        self.times = times
        self.steps, self.true_steps = steps_of(positions(poses)), steps_of(positions(true_poses))
        first, last = event_s or (times[0], times[-1] + 1.0)
        self.has_event = event_s is not None
        self.event = [i for i in range(len(frames)) if first <= times[i] - times[0] <= last]
        self.after = list(range(self.event[-1] + 1, len(frames))) if self.event else []

    @functools.cached_property
    def speed_errors(self):
        """Errors of the stated speeds; infinite where none is stated."""
        errors = [math.inf]
        for i in range(1, len(self.frames)):
            step = self.frames[i]['step_m']
            errors.append(abs(float(step) - self.true_steps[i]) / self._interval_s(i) if step else math.inf)
        return errors

    def _interval_s(self, i):
        return self.times[i] - self.times[i - 1]

    def speed_is_right(self, i):
        true_speed = self.true_steps[i] / self._interval_s(i)
        return self.speed_errors[i] <= max(SPEED_BOUND_RATIO * true_speed, SPEED_BOUND_M_S)

    def count(self, column, indices):
        """How often each word stands in a column."""
        return dict(collections.Counter(self.frames[i][column] or 'silent' for i in indices))

    def figures(self):
        """Every figure that a case may bound."""
        result = {'frames': len(self.frames), **self._status_figures(), **self._height_figures(),
                  **self._speed_figures(), **self._trust_figures()}
        if self.event:
            result.update(self._event_figures())
        if self.has_event and self.after:
            result.update(self._recovery_figures())
        result['path_percent'] = percent_longer(sum(self.steps), sum(self.true_steps))
        return result

    def _status_figures(self):
        frames, event = self.frames, set(self.event) if self.has_event else set()
        outside = [i for i in range(START_FRAMES, len(frames)) if i not in event]
        with_scale = (i for i, frame in enumerate(frames) if frame['ego_status'] in ('ok', 'scale_held'))
        return {'status': self.count('ego_status', range(len(frames))),
                'event_status': self.count('ego_status', self.event),
                'event_reason': self.count('ego_reason', self.event),
                'lost_outside': sum(frames[i]['ego_status'] in ('lost', 'initializing', '') for i in outside),
                'start_frames': next(with_scale, math.inf),
                'num_epochs': int(frames[-1]['scale_epoch'] or 0),
                'resets': int(frames[-1]['reset_counter'])}

    def _height_figures(self):
        errors = [100.0 * abs(number(frame['height_m']) / self.planes[i] - 1.0)
                  for i, frame in enumerate(self.frames) if frame['plane_status'] == 'ok' and i in self.planes]
        if not errors:
            errors = [math.nan]
        return {'height_mean_percent': sum(errors) / len(errors), 'height_max_percent': max(errors),
                'height_within_7_percent': math.nan if math.isnan(errors[0]) else
                100.0 * sum(e <= 7.0 for e in errors) / len(errors)}

    def _speed_figures(self):
        errors = self.speed_errors
        in_event = [errors[i] for i in self.event if math.isfinite(errors[i])]
        covered = [errors[i] <= 3.0 * number(frame['speed_std_m_s']) for i, frame in enumerate(self.frames)
                   if math.isfinite(errors[i]) and frame['ego_status'] != 'standstill']
        return {'speed_error_max_m_s': max(in_event, default=math.nan),
                'speed_error_median_m_s': quantile(in_event, 0.5),
                'speed_covered_percent': 100.0 * sum(covered) / len(covered) if covered else math.nan}

    def _trust_figures(self):
        """How many images are right, how many are stated and wrong, and how many deny that we move."""
        late = [i for i in range(1, len(self.frames)) if self.times[i] - self.times[0] >= START_S]
        right = sum(self.speed_is_right(i) for i in late)
        return {'right_percent': 100.0 * right / len(late) if late else math.nan,
                'wrong_percent': 100.0 * sum(map(self._is_wrong, range(1, len(self.frames)))) / len(self.frames),
                'denied_frames': sum(self.frames[i]['ego_status'] == 'standstill' and
                                     self.true_steps[i] > MOVING_M_S * self._interval_s(i)
                                     for i in range(1, len(self.frames)))}

    def _is_wrong(self, i):
        error, std = self.speed_errors[i], number(self.frames[i]['speed_std_m_s'])
        return math.isfinite(error) and not self.speed_is_right(i) and not error <= 3.0 * std

    def _event_figures(self):
        poses, true_poses, first = self.poses, self.true_poses, self.event[0]
        places = positions(poses)
        turn_errors = [math.degrees(abs(rotation_between_rad(true_poses[first], true_poses[i]) -
                                        rotation_between_rad(poses[first], poses[i]))) for i in self.event]
        return {'event_path_true_m': sum(self.true_steps[i] for i in self.event[1:]),
                'event_moved_m': max(math.dist(places[i], places[first]) for i in self.event),
                'event_turn_error_deg': turn_errors[-1],
                'event_turn_error_max_deg': max(turn_errors)}

    def _recovery_figures(self):
        right = [self.speed_is_right(i) for i in self.after]
        settled = (k for k in range(len(right)) if all(right[k:k + SETTLED_FRAMES]))
        return {'recovery_frames': next(settled, math.inf),
                'path_after_percent': percent_longer(sum(self.steps[i] for i in self.after[1:]),
                                                     sum(self.true_steps[i] for i in self.after[1:]))}
