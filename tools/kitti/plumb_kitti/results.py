"""Reads what the jobs left for the report."""
import json
import math
import pathlib

from plumb_tools.drive_files import number, read_frames, read_poses
from plumb_tools.figures import pooled

CURVES = {'points alone': ('paper', 'points'), 'dense alone': ('paper', 'dense'), 'fixed': ('paper-fixed', 'fused'),
          'adaptive': ('paper', 'fused'), 'default': ('default', 'fused'), 'constant': ('default', 'constant')}


def read_json(path):
    """The file's content, or None when there is none."""
    return json.loads(path.read_text()) if path.exists() else None


class Results:
    """The results below a folder, by drive, mode and trial."""

    def __init__(self, out, plan):
        self.out, self.plan = pathlib.Path(out), plan
        self.runs = {(d, m, t): result for d in plan['drives'] for m in plan['modes'] for t in
                     range(len(plan['trials'][d]))
                     if (result := read_json(self.folder(d, m, t) / 'result.json')) is not None}
        self.comparisons = read_json(self.out / 'comparisons.json') or []

    def folder(self, drive, mode, trial=0):
        return self.out / 'runs' / drive / mode / str(trial)

    def with_truth(self):
        """The drives whose undisturbed default run was measured."""
        return [d for d in self.plan['drives'] if 'short' in self.runs.get((d, 'default', 0), {})]

    def errors(self, drives, mode, kind, trial=0):
        """(t in %, r in deg/m) pooled over segments of the drives, or None."""
        return pooled([self.runs[d, mode, trial].get(kind) for d in drives if (d, mode, trial) in self.runs])

    def trials(self, drive, mode, kind):
        """[(t, r)] of every trial of a drive that has segments."""
        found = [self.errors([drive], mode, kind, t) for t in range(len(self.plan['trials'][drive]))]
        return [errors for errors in found if errors]

    def heights(self, drive, curve):
        """The summary of a curve of Figs 9 and 10 for a drive, or None."""
        mode, kind = CURVES[curve]
        summary = self.runs.get((drive, mode, 0), {}).get('height', {}).get(kind)
        return summary if summary and summary['num_frames'] else None

    def pooled_height(self, drives, curve, key='mean_percent'):
        """The curve's mean over all frames of the drives, or None."""
        entries = [s for s in (self.heights(d, curve) for d in drives) if s]
        total = sum(s['num_frames'] for s in entries)
        return sum(s[key] * s['num_frames'] for s in entries) / total if total else None

    def height_curve(self, drive, curve):
        """[(frame, error in percent)] of the undisturbed run."""
        mode, kind = CURVES[curve]
        errors = (read_json(self.folder(drive, mode) / 'height.json') or {}).get(kind)
        return list(zip(errors['frames'], errors['errors_percent'])) if errors else []

    def frames(self, drive, mode='default'):
        path = self.folder(drive, mode) / 'frames.csv'
        return read_frames(path) if path.exists() else []

    def path_from_above(self, path):
        """[(right, ahead)] in metres from the first camera, of a pose file."""
        from plumb_tools.accuracy.pictures import top_view
        return top_view(read_poses(path)) if path.exists() else []

    def true_planes(self, drive):
        """{frame: (pitch in degrees, height in m)} of the true planes; pitch as plumb-eval plane takes it."""
        path = self.folder(drive, 'default') / 'planes.txt'
        planes = {}
        for line in path.read_text().splitlines() if path.exists() else []:
            if not line.startswith('#'):
                frame, _, down, ahead, height = (float(word) for word in line.split()[:5])
                planes[int(frame)] = (math.degrees(math.atan2(ahead, down)), height)
        return planes

    def placed(self, drive, boxes, plane):
        return read_json(self.out / 'placed' / drive / boxes / plane / 'result.json') or {}


def measured(frames, *columns):
    """Rows of numbers of the frames that have all the columns."""
    rows = []
    for frame in frames:
        values = [number(frame[column]) for column in columns]
        if all(math.isfinite(value) for value in values):
            rows.append(values)
    return rows
