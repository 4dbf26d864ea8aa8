"""Tables and pages in Markdown and HTML."""
import html

STYLE = ('body{font:15px/1.5 system-ui,sans-serif;max-width:1280px;margin:2em auto;padding:0 1em;color:#222}'
         'table{border-collapse:collapse;font-size:13px}'
         'td,th{padding:2px 10px;border-bottom:1px solid #ddd;text-align:left}'
         'pre{background:#f5f5f2;padding:1em;overflow:auto;font-size:13px}'
         'img{max-width:100%;border:1px solid #ddd}figure{margin:1em 0}'
         'p,figcaption{color:#555}figcaption{font-size:13px}')


def markdown_table(head, rows):
    """Lines of a Markdown table; every cell is text."""
    return ['| ' + ' | '.join(row) + ' |' for row in [head]] + ['|' + '---|' * len(head)] + [
        '| ' + ' | '.join(row) + ' |' for row in rows]


def html_table(head, rows):
    """An HTML table; every cell is text."""
    def row(cells, tag):
        return '<tr>' + ''.join(f'<{tag}>{html.escape(c)}</{tag}>' for c in cells) + '</tr>'
    return '<table>' + '\n'.join([row(head, 'th')] + [row(cells, 'td') for cells in rows]) + '</table>'


def html_text(title, text):
    """A section of preformatted text."""
    return f'<h2>{html.escape(title)}</h2>\n<pre>{html.escape(text)}</pre>'


def html_picture(path, caption):
    """A picture with its caption."""
    name = html.escape(caption)
    return f'<figure><img src="{html.escape(path)}" alt="{name}"><figcaption>{name}</figcaption></figure>'


def html_page(title, sections):
    """A page of its own."""
    name = html.escape(title)
    return '\n'.join([f'<!doctype html><html lang="en"><head><meta charset="utf-8"><title>{name}</title>'
                      f'<style>{STYLE}</style></head><body><h1>{name}</h1>', *sections, '</body></html>']) + '\n'
