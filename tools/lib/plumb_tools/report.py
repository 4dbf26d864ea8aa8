"""One page about what tools/demo left in a folder: the tool tools/evaluate/report."""
import os
import pathlib

from plumb_tools import command_line, markup

TITLE = 'Plumbline: one drive, images in, CAN out'
PICTURE_ENDINGS = ('.png', '.svg', '.jpg')
TRACE_LINES = 24
TEXTS = {'Odometry against truth': 'eval.txt', 'Ground plane against truth': 'plane.txt',
         'Objects against truth': 'placed.txt', 'Live against replay': 'live/compare.txt',
         'Replay: speed and stages': 'replay.txt'}


def text_section(folder, title, name, num_lines=None):
    """The file as a section, or nothing when it is missing or empty."""
    path = folder / name
    if not path.is_file() or path.stat().st_size == 0:
        return []
    lines = path.read_text(errors='replace').splitlines()[:num_lines]
    return [markup.html_text(title, '\n'.join(lines))]


def picture_section(folder, title, name):
    """The pictures of a folder, or nothing when there are none."""
    files = sorted(path.name for path in (folder / name).glob('*') if path.suffix in PICTURE_ENDINGS)
    if not files:
        return []
    return [f'<h2>{title}</h2>'] + [markup.html_picture(f'{name}/{file}', file) for file in files]


def page(folder):
    """The whole page."""
    sections = picture_section(folder, 'What the module sees', 'pictures')
    for title, name in TEXTS.items():
        sections += text_section(folder, title, name)
    sections += picture_section(folder, 'Plots', 'plots')
    sections += text_section(folder, 'CAN trace, first frames', 'replay.can', TRACE_LINES)
    for log in sorted((folder / 'live').glob('*.log')):
        sections += text_section(folder, f'Process {log.stem}', os.path.join('live', log.name))
    return markup.html_page(TITLE, sections)


def main():
    parser = command_line.Parser('report')
    parser.add_argument('folder', metavar='DIR', type=command_line.folder)
    folder: pathlib.Path = parser.parse_args().folder
    (folder / 'report.html').write_text(page(folder))
