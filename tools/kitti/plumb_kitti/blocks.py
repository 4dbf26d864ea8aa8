"""The pieces of a report page as plain dictionaries: tables, charts and notes."""
import math

MOST_POINTS = 1200  # of a curve; more of them no screen shows


def finite(value, digits=4):
    """A number short enough for the page; None for what is no number."""
    return None if value is None or not math.isfinite(value) else float(f'{value:.{digits + 2}g}')


def thin(points):
    """Every n-th point of a curve, so that at most MOST_POINTS are left, and the last one."""
    step = max(1, math.ceil(len(points) / MOST_POINTS))
    return points[::step] + (points[-1:] if step > 1 and (len(points) - 1) % step else [])


def table(head, rows, caption=''):
    return {'type': 'table', 'head': list(head), 'rows': [[str(cell) for cell in row] for row in rows],
            'caption': caption}


def note(text):
    return {'type': 'note', 'text': text}


def curve(name, points, dots=False):
    """A curve of (x, y); `dots` draws marks instead of a line."""
    kept = thin(points)
    return {'name': name, 'dots': dots, 'x': [finite(p[0]) for p in kept], 'y': [finite(p[1]) for p in kept]}


def band(name, points):
    """A curve of (x, y, standard deviation) with its band of one standard deviation."""
    kept = thin(points)
    return {**curve(name, kept), 'low': [finite(p[1] - p[2]) for p in kept], 'high': [finite(p[1] + p[2]) for p in kept]}


def lines(caption, x, y, curves, equal=False):
    """A chart of curves, or None without any; `equal` gives both axes one scale."""
    curves = [c for c in curves if c['x']]
    return {'type': 'lines', 'caption': caption, 'x': x, 'y': y, 'curves': curves, 'equal': equal} if curves else None


def bars(caption, y, rows):
    """A chart of grouped bars, rows (group, name, value), or None without any; the page also shows them as a table."""
    rows = [{'group': g, 'name': n, 'value': finite(v)} for g, n, v in rows if finite(v) is not None]
    return {'type': 'bars', 'caption': caption, 'y': y, 'rows': rows} if rows else None


def heat(caption, x, y, what, cells):
    """A histogram over two quantities, cells (x from, x to, y from, y to, number of `what`), or None without any."""
    keys = ('x1', 'x2', 'y1', 'y2')
    rows = [{**{key: finite(value) for key, value in zip(keys, cell)}, 'n': cell[4]} for cell in cells]
    return {'type': 'heat', 'caption': caption, 'x': x, 'y': y, 'what': what, 'rows': rows} if rows else None


def section(key, title, blocks, paper=''):
    """A section; one without any block says that its data is missing."""
    return {'id': key, 'title': title, 'paper': paper, 'blocks': [block for block in blocks if block]}
