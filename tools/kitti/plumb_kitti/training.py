"""The sections of the report about Algorithm 1, Figs 3 to 8: what a confidence is, and how it tells the error."""
import bisect
import csv
import math

from plumb_kitti.blocks import curve, heat, lines, note, section
from plumb_kitti.results import read_json

# The lines that plumb-train fits: (its name, columns of the samples, figure of the histogram, figure of the line, unit).
MODELS = [('h', 'paper_width_height', 'paper_err_height', 'Fig. 4: dense, height', 'Fig. 5: dense, height', 'm'),
          ('n1', 'paper_width_n1', 'paper_err_n1', 'Fig. 4: dense, n1', 'Fig. 5: dense, n1', '1'),
          ('n3', 'paper_width_n3', 'paper_err_n3', 'Fig. 4: dense, n3', 'Fig. 5: dense, n3', '1'),
          ('points h', 'paper_vote', 'paper_err_points', 'Fig. 6a: points, height', 'Fig. 6b: points, height', 'm')]
MOST_BINS = 100     # the paper's
LEAST_IN_BIN = 8
ERROR_BINS = 16
LAST_QUANTILE = 0.98  # errors beyond it would make the picture empty; they count as the last bin


def samples_of(results):
    """Every row of the samples, as texts by column."""
    rows = []
    for path in sorted((results.out / 'fit/samples').glob('*.csv')):
        with open(path, newline='') as file:
            rows += list(csv.DictReader(line for line in file if not line.startswith('#')))
    return rows


def pairs_of(rows, confidence, error):
    """[(confidence, |error|)] of the rows that have both."""
    pairs = []
    for row in rows:
        values = [float(row[name]) if row.get(name) else math.nan for name in (confidence, error)]
        if all(math.isfinite(value) for value in values):
            pairs.append((values[0], abs(values[1])))
    return sorted(pairs)


def histogram(pairs):
    """[(confidence from, to, error from, to, number)]: bins of equal count over the confidence, as Algorithm 1 has them."""
    num_bins = min(MOST_BINS, len(pairs) // LEAST_IN_BIN)
    if num_bins < 2:
        return []
    errors = sorted(error for _, error in pairs)
    top = errors[int(LAST_QUANTILE * (len(errors) - 1))] or 1.0
    edges = [top * k / ERROR_BINS for k in range(ERROR_BINS + 1)]
    ends = [pairs[min(len(pairs) - 1, k * len(pairs) // num_bins)][0] for k in range(num_bins + 1)]
    cells = []
    for k in range(num_bins):
        counts = [0] * ERROR_BINS
        for _, error in pairs[k * len(pairs) // num_bins:(k + 1) * len(pairs) // num_bins]:
            counts[min(ERROR_BINS - 1, bisect.bisect_right(edges, error) - 1)] += 1
        cells += [(ends[k], ends[k + 1], edges[i], edges[i + 1], n) for i, n in enumerate(counts) if n]
    return [cell for cell in cells if cell[1] > cell[0]]


def line_chart(title, fit, unit):
    """Bins and line of one model C, as Figs 5, 6b and 8 show them."""
    bins = [(b['confidence'], b['variance']) for b in fit['bins']]
    if not bins:
        return None
    ends = [min(b[0] for b in bins), max(b[0] for b in bins)]
    straight = curve('line', [(x, fit['offset'] + fit['slope'] * x) for x in ends])
    return lines(title, 'accuracy parameter', f'variance of the error [{unit}²]', [curve('bins', bins, True), straight])


def training(results):
    fits = {fit['name']: fit for fit in (read_json(results.out / 'fit/fit.json') or {}).get('paper', [])}
    rows, charts = samples_of(results), []
    for name, confidence, error, figure, line_figure, unit in MODELS:
        cells = histogram(pairs_of(rows, confidence, error))
        charts.append(heat(f'{figure}: images by accuracy parameter and size of the error', 'accuracy parameter',
                           f'error [{unit}]', 'images', cells))
        if name in fits:
            charts.append(line_chart(line_figure, fits[name], unit))
    text = ('The models C of Algorithm 1, fitted to the drives at hand; the runs above use the shipped model. The accuracy '
            'parameter of dense stereo is the width of the Gaussian, that of the points is the score of the vote.')
    return section('training', 'Figs 3 to 8: training', [note(text)] + charts)
