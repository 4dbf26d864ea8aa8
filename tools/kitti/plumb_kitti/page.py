"""Makes the page: tables as plain HTML, and charts drawn by a script that npm's esbuild bundles."""
import html
import json
import pathlib
import shutil
import subprocess

from plumb_tools.command_line import UsageError

SOURCE = pathlib.Path(__file__).resolve().parents[1] / 'page'
BUNDLED = ('package.json', 'package-lock.json', 'charts.js')


def bundle(job):
    """Leaves page/bundle.js. Without npm it is empty, and the page says so and shows tables alone."""
    folder = job.out / 'page'
    folder.mkdir(exist_ok=True)
    target = folder / 'bundle.js'
    if not shutil.which('npm'):
        target.write_text('')
        return
    for name in BUNDLED:
        shutil.copyfile(SOURCE / name, folder / name)
    for words in (['npm', 'ci', '--ignore-scripts', '--no-audit', '--no-fund'], ['npm', 'run', '--silent', 'bundle']):
        done = subprocess.run(words, cwd=folder, capture_output=True, text=True)
        if done.returncode:
            said = (done.stderr or done.stdout).strip().splitlines()
            raise UsageError(f"{' '.join(words)} failed: {said[-1] if said else done.returncode}")
    (folder / 'bundle.part.js').replace(target)


def table_html(block):
    def cells(row, tag):
        return '<tr>' + ''.join(f'<{tag}>{html.escape(str(c))}</{tag}>' for c in row) + '</tr>'
    caption = f"<caption>{html.escape(block['caption'])}</caption>" if block['caption'] else ''
    body = '\n'.join(cells(row, 'td') for row in block['rows'])
    return (f'<div class="scroll"><table>{caption}<thead>{cells(block["head"], "th")}</thead>'
            f'<tbody>{body}</tbody></table></div>')


def bars_table(block):
    """The values of a bar chart as a table of groups by names."""
    names = list(dict.fromkeys(row['name'] for row in block['rows']))
    values = {(row['group'], row['name']): row['value'] for row in block['rows']}
    rows = [[group] + [f'{values[group, name]:.2f}' if (group, name) in values else '-' for name in names]
            for group in dict.fromkeys(row['group'] for row in block['rows'])]
    return table_html({'head': [''] + names, 'rows': rows, 'caption': ''})


def block_html(block, key):
    if block['type'] == 'table':
        return table_html(block)
    if block['type'] == 'note':
        return f"<p>{html.escape(block['text'])}</p>"
    under = f'<details><summary>Values</summary>{bars_table(block)}</details>' if block['type'] == 'bars' else ''
    kind = ' class="map"' if block.get('equal') else ''
    return (f'<figure{kind}><div class="chart" data-chart="{key}"></div>'
            f"<figcaption>{html.escape(block['caption'])}</figcaption>{under}</figure>")


def section_html(section, charts):
    parts = [f"<section id=\"{section['id']}\"><h2>{html.escape(section['title'])}</h2>"]
    if section['paper']:
        parts.append(f"<p class=\"paper\">The paper: {html.escape(section['paper'])}</p>")
    if not any(block['type'] != 'note' for block in section['blocks']):
        parts.append('<p class="missing">Data not here: <a href="#data">what to download</a>.</p>')
    for block in section['blocks']:
        parts.append(block_html(block, len(charts)))
        if block['type'] in ('lines', 'bars', 'heat'):
            charts.append(block)
    return '\n'.join(parts + ['</section>'])


def html_of(data, folder):
    """The whole page as one text, which refers to nothing outside."""
    charts = []
    body = '\n'.join(section_html(section, charts) for section in data['sections'])
    contents = ''.join(f"<li><a href=\"#{s['id']}\">{html.escape(s['title'])}</a></li>" for s in data['sections'])
    cards = ''.join(f"<div class=\"card\"><b>{html.escape(h['value'])}</b><span>{html.escape(h['what'])}</span>"
                    f"<small>{html.escape(h['beside'])}</small></div>" for h in data['headline'])
    script = (folder / 'bundle.js').read_text()
    without = '' if script else '<p class="missing">npm was not here when this page was made, so it has no charts.</p>'
    text = json.dumps(charts, separators=(',', ':'), sort_keys=True).replace('<', '\\u003c')
    style = (SOURCE / 'style.css').read_text()
    title = html.escape(data['title'])
    return (f'<!doctype html>\n<html lang="en"><head><meta charset="utf-8"><meta name="viewport" '
            f'content="width=device-width"><title>{title}</title><link rel="icon" href="data:,"><style>{style}</style></head>'
            f'<body><header><h1>{title}</h1></header><div class="cards">{cards}</div>{without}'
            f'<nav><ol>{contents}</ol></nav><main>{body}</main>\n'
            f'<script type="application/json" id="charts">{text}</script>\n<script>{script}</script></body></html>\n')
