"""Means and quantiles of lists with gaps, and numbers as table cells."""
import math
import statistics


def known(values):
    """The values that are neither None nor NaN."""
    return [v for v in values if v is not None and not math.isnan(v)]


def mean(values):
    """The mean of the known values. None when no value is known."""
    values = known(values)
    return sum(values) / len(values) if values else None


def standard_deviation(values):
    """None when fewer than two values are known."""
    values = known(values)
    return statistics.stdev(values) if len(values) > 1 else None


def quantile(values, q):
    """The order statistic at rank q * n; NaN for an empty list."""
    values = sorted(values)
    return values[min(len(values) - 1, int(q * len(values)))] if values else math.nan


def cell(value, digits=2):
    """A number as text, '-' when it is not known."""
    return '-' if value is None or math.isnan(value) else f'{value:.{digits}f}'


def pooled(entries):
    """(t in %, r in deg/m) over all segments of several reports. None without segments."""
    entries = [e for e in entries if e and e['num_segments']]
    num_segments = sum(e['num_segments'] for e in entries)
    if num_segments == 0:
        return None
    return tuple(sum(e[key] * e['num_segments'] for e in entries) / num_segments
                 for key in ('t_percent', 'r_deg_m'))
