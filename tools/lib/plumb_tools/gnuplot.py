"""Pictures of curves, drawn by gnuplot."""
import subprocess

from plumb_tools.command_line import UsageError

COLOURS = ('#0072bd', '#d95319', '#77ac30', '#7e2f8e', '#edb120', '#4dbeee', '#a2142f')


class Curve:
    """Points with a title, drawn as a line or as dots."""

    def __init__(self, title, points, dots=False):
        self.title, self.points, self.dots = title, points, dots


def _quoted(text):
    return "'" + text.replace("'", "''") + "'"


def script(path, title, x_label, y_label, curves, square=False):
    """The gnuplot script for curves that all have points."""
    lines = []
    for i, curve in enumerate(curves):
        lines += [f'$c{i} << EOD', *(f'{x:.9g} {y:.9g}' for x, y in curve.points), 'EOD']
    lines += ['set terminal pngcairo size 900,520 noenhanced', f'set output {_quoted(str(path))}',
              f'set title {_quoted(title)}', f'set xlabel {_quoted(x_label)}', f'set ylabel {_quoted(y_label)}',
              "set grid lc rgb '#dddddd'", 'set key outside top right']
    if square:
        lines.append('set size ratio -1')
    plots = [f"$c{i} with {'points pt 7 ps 0.4' if curve.dots else 'lines lw 2'} "
             f"lc rgb '{COLOURS[i % len(COLOURS)]}' title {_quoted(curve.title)}"
             for i, curve in enumerate(curves)]
    return '\n'.join(lines + ['plot ' + ', '.join(plots)]) + '\n'


def draw(path, title, x_label, y_label, curves, square=False):
    """Draws the curves that have points into a PNG file. False when none has any."""
    curves = [curve for curve in curves if curve.points]
    if not curves:
        return False
    text = script(path, title, x_label, y_label, curves, square)
    try:
        done = subprocess.run(['gnuplot'], input=text, text=True, capture_output=True)
    except FileNotFoundError:
        raise UsageError('gnuplot is not installed (package gnuplot-nox)') from None
    if done.returncode != 0:
        raise UsageError(f'gnuplot could not draw {path}: {done.stderr.strip().splitlines()[-1:]}')
    return True
