"""The report of a bench as Markdown and HTML."""
import datetime
import html

from plumb_tools import markup
from plumb_tools.accuracy import pictures, tables


def sections_of(bench):
    """(title, remark, (head, rows)) of every table that has rows."""
    scores = {mode: bench.scores(mode) for mode in bench.modes}
    sections = [
        ('Accuracy over all drives', 'KITTI metric, t in %, r in deg/m; pooled over segments, means over seeds.',
         tables.accuracy(bench)),
        ('Height of the road plane', 'Reported height against true planes, for the drives that have them.',
         tables.heights(bench)),
        ('Success', '', tables.success(bench)),
        ('Calibration of stated variances', 'Squared error over stated variance, mean over drives: 1 is right. The '
         "brackets count the drives in 0.7..1.5. Step length includes the truth's own jitter.",
         tables.calibration(scores)),
        ('Times', 'Wall time per frame of the first seed; several runs at once make each slower.', tables.times(bench)),
        ('Accuracy per drive', '', tables.accuracy_per_drive(bench)),
        ('Calibration per drive', '', tables.calibration_per_drive(scores, bench.drives))]
    return [section for section in sections if section[2][1]]


def write(bench, command):
    """Writes report.md and report.html; returns the lines of the tables in Markdown."""
    sections, shown = sections_of(bench), pictures.draw_all(bench)
    title = f'Accuracy of {len(bench.drives)} drives in {len(bench.modes)} modes with {len(bench.seeds)} seeds'
    now = datetime.datetime.now(datetime.timezone.utc)
    origin = f'`{command}`, {now:%Y-%m-%d %H:%M} UTC'
    lines = ['# ' + title, '', origin, '']
    page = [f'<p>{html.escape(origin)}</p>']
    for name, remark, (head, rows) in sections:
        lines += ['## ' + name, '', remark, '', *markup.markdown_table(head, rows), '']
        page.append(f'<h2>{name}</h2><p>{html.escape(remark)}</p>' + markup.html_table(head, rows))
    images = ['## Pictures', ''] + [f'![{name}](pictures/{name}.png)' for name in shown]
    page += ['<h2>Pictures</h2>'] + [markup.html_picture(f'pictures/{name}.png', name) for name in shown]
    (bench.out / 'report.md').write_text('\n'.join(lines + images) + '\n')
    (bench.out / 'report.html').write_text(markup.html_page(title, page))
    return lines
