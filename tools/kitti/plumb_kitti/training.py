"""The section of the report about Algorithm 1, Figs 3 to 8: what a confidence is, and how it tells the error."""
import bisect
import csv
import math

from plumb_kitti.blocks import curve, heat, lines, note, section
from plumb_kitti.results import read_json

# The lines that plumb-train fits: (its name, columns of the samples, figure of the histogram, figure of the line, unit).
MODELS = {
    'samples': [
        ('h', 'paper_width_height', 'paper_err_height', 'Fig. 4: dense, height', 'Fig. 5: dense, height', 'm'),
        ('n1', 'paper_width_n1', 'paper_err_n1', 'Fig. 4: dense, n1', 'Fig. 5: dense, n1', '1'),
        ('n3', 'paper_width_n3', 'paper_err_n3', 'Fig. 4: dense, n3', 'Fig. 5: dense, n3', '1'),
        ('points h', 'paper_vote', 'paper_err_points', 'Fig. 6a: points, height', 'Fig. 6b: points, height', 'm')],
    'boxes': [('objects n3', 'objects_confidence', 'objects_error', 'Fig. 8: objects, n3', 'Fig. 8: objects, n3', '1')],
}
MOST_BINS = 100     # the paper's
LEAST_IN_BIN = 8
ERROR_BINS = 16
LAST_QUANTILE = 0.98  # errors beyond it would make the picture empty; they count as the last bin


def rows_of(folder):
    """Every row of a folder's tables, as texts by column."""
    rows = []
    for path in sorted(folder.glob('*.csv')):
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


def gaussian_curve(low, high, value):
    """[(x, value(x))] over a range."""
    return [(x, value(x)) for x in (low + (high - low) * k / 100 for k in range(101))]


def figure_3(example):
    """The cost along each component beside its Gaussian."""
    charts = []
    for part in example.get('slices', []):
        g, x = part.get('gaussian'), part['x']
        curves = [curve('cost', list(zip(x, part['cost'])), True)]
        if g:
            curves.append(curve('line', gaussian_curve(x[0], x[-1], lambda at, g=g: g['offset'] - g['depth'] * math.exp(
                -0.5 * ((at - g['centre']) / g['width']) ** 2))))
        width = f", width {g['width']:.4f}" if g else ', which has no dip to fit'
        charts.append(lines(f"Fig. 3: cost (7) along {part['component']}, image {example['seq']} of {example['drive']}{width}",
                            part['component'] + (' [m]' if part['component'] == 'h' else ''), 'cost', curves))
    return charts


def figure_7(example):
    """The scores of one object's candidates beside the Gaussian that is nearest to its box."""
    found = example.get('object')
    charts = []
    for key, what in (('lower_edge_px', 'lower edge'), ('height_px', 'height of the box')):
        if not found:
            continue
        g, dots = found['gaussian'], [(c[key], c['score']) for c in found['candidates']]
        std = math.sqrt(g[key.replace('_px', '_var_px2')])
        low, high = min([g[key] - 2 * std, *(d[0] for d in dots)]), max([g[key] + 2 * std, *(d[0] for d in dots)])
        value = lambda at, key=key, std=std: g['amplitude'] * math.exp(-0.5 * ((at - g[key]) / std) ** 2)
        charts.append(lines(f"Fig. 7: candidates by their {what}, image {found['seq']} of {example['drive']}; a_d = "
                            f"{found['confidence_px2']:.2f} px²", f'{what} [px]', 'score', [
                                curve('candidates', dots, True), curve('line', gaussian_curve(low, high, value))]))
    return charts


def models(results, fits):
    """Figs 4 to 6 and 8: histograms, and the lines fitted to them."""
    charts = []
    for folder, rows in ((folder, rows_of(results.out / 'fit' / folder)) for folder in ('samples', 'boxes')):
        for name, confidence, error, figure, line_figure, unit in MODELS[folder]:
            cells = histogram(pairs_of(rows, confidence, error))
            what = 'objects' if folder == 'boxes' else 'images'
            charts.append(heat(f'{figure}: {what} by accuracy parameter and size of the error', 'accuracy parameter',
                               f'error [{unit}]', what, cells))
            if name in fits:
                charts.append(line_chart(line_figure, fits[name], unit))
    return charts


def training(results):
    fits = {fit['name']: fit for fit in (read_json(results.out / 'fit/fit.json') or {}).get('paper', [])}
    example = read_json(results.out / 'fit/example.json') or {}
    text = ('The models C of Algorithm 1, fitted to the drives at hand; the runs above use the shipped model. The accuracy '
            'parameter of dense stereo is the width of the Gaussian, that of the points is the score of the vote, and that of '
            'objects is a_d of the mixture (10).')
    without = None
    if 'object' not in example:
        without = note('Figs 7 and 8 want a detector\'s boxes from before suppression: --detector FILE, or candidates/DRIVE.txt '
                       'beside the labels.')
    return section('training', 'Figs 3 to 8: training',
                   [note(text), without, *figure_3(example), *models(results, fits), *figure_7(example)],
                   'straight lines suffice for all of Figs 5, 6b and 8 (figures without printed values).')
