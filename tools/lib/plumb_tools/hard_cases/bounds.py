"""Compares the figures of a case with its bounds, and shows them as a row of a table."""
import math

from plumb_tools.command_line import UsageError

SEEN = {'event_statuses': ('event_status', 'is'), 'event_reasons': ('event_reason', 'has the reason')}

COLUMNS = ['case', 'what', 'ego status: frames', 'reason in the event', 'first scale at frame',
           'height error mean / max %', 't % (10, 20, 50 m)', 'path %',
           'speed error in the event, median / max m/s', 'within 3 stated standard deviations %',
           'right / stated and wrong %', 'standstill while moving',
           'moved in the event, true / found m', 'recovery frames', 'path after %']


def broken_bounds(case, figures):
    """One sentence per bound that is broken.

    FIGURE_most and FIGURE_least bound a figure, event_statuses and event_reasons list words that
    the event must show.
    """
    broken = []
    for key, bound in case.get('bounds', {}).items():
        if key in SEEN:
            figure, verb = SEEN[key]
            missing = [word for word in bound if word not in figures[figure]]
            if missing:
                broken.append(f"{case['name']}: no frame of the event {verb} {', '.join(missing)}")
            continue
        figure, _, side = key.rpartition('_')
        if side not in ('least', 'most') or figure not in figures:
            raise UsageError(f"{case['name']}: no figure named '{key}'")
        value = figures[figure]
        kept = value >= bound if side == 'least' else value <= bound  # NaN breaks a bound
        if not kept:
            broken.append(f"{case['name']}: {figure} is {value:.4g}, bound {side} {bound:.4g}")
    return broken


def _counted(counts):
    words = sorted(((word, n) for word, n in counts.items() if word != 'none'), key=lambda entry: -entry[1])
    return ', '.join(f'{word} {n}' for word, n in words) or '-'


def table_row(case, figures):
    """The cells of COLUMNS."""
    def cell(key, form='.2f'):
        value = figures.get(key, math.nan)
        if math.isnan(value):
            return '-'
        return 'never' if value == math.inf else format(value, form)

    moved = cell('event_path_true_m') + ' / ' + cell('event_moved_m') if 'event_s' in case else '-'
    return [case['name'], case['what'], _counted(figures['status']), _counted(figures['event_reason']),
            cell('start_frames', '.0f'), cell('height_mean_percent') + ' / ' + cell('height_max_percent', '.1f'),
            cell('t_percent'), cell('path_percent', '+.1f'),
            cell('speed_error_median_m_s') + ' / ' + cell('speed_error_max_m_s'),
            cell('speed_covered_percent', '.0f'), cell('right_percent', '.0f') + ' / ' + cell('wrong_percent', '.1f'),
            cell('denied_frames', '.0f'), moved, cell('recovery_frames', '.0f'),
            cell('path_after_percent', '+.1f')]
