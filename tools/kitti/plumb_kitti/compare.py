"""Comparisons of modes with confidence intervals, per drive and pooled; plumb-eval compare measures them."""
import json

from plumb_kitti.jobs import write_json

# (name, what is compared, (mode, kind), (mode, kind)); no kind stands for every segment's length.
COMPARISONS = [
    ('adaptive against fixed', 'height', ('paper', 'fused'), ('paper-fixed', 'fused')),
    ('fixed against dense alone', 'height', ('paper-fixed', 'fused'), ('paper', 'dense')),
    ('dense alone against points alone', 'height', ('paper', 'dense'), ('paper', 'points')),
    ('adaptive against a constant', 'height', ('paper', 'fused'), ('paper', 'constant')),
    ('default against adaptive', 'height', ('default', 'fused'), ('paper', 'fused')),
    ('default against a constant', 'height', ('default', 'fused'), ('default', 'constant')),
    ('default against adaptive', 'short', ('default', ''), ('paper', '')),
    ('default against adaptive', 'long', ('default', ''), ('paper', '')),
    ('adaptive against fixed', 'short', ('paper', ''), ('paper-fixed', '')),
]
POOLED = 'pooled'


def samples_of(job, names, mode, measure):
    """The samples of several drives as one text, without heads but the first; the drive's name comes first."""
    lines = []
    for name in names:
        path = job.out / 'runs' / name / mode / '0' / f'{measure}.csv'
        if path.exists():
            rows = path.read_text().splitlines()
            lines += rows[:1] if not lines else []
            lines += [name + ',' + row.partition(',')[2] for row in rows[1:]]
    return lines


def compare_on(job, names, measure, first, second):
    """What plumb-eval says of the drives together, or None without common samples."""
    folder = job.out / 'compare'
    folder.mkdir(exist_ok=True)
    files = [folder / 'first.csv', folder / 'second.csv']
    for path, (mode, _) in zip(files, (first, second)):
        lines = samples_of(job, names, mode, measure)
        if len(lines) < 2:
            return None
        path.write_text('\n'.join(lines) + '\n')
    kinds = ['--of', first[1], '--against', second[1]] if first[1] else []
    report = folder / 'comparison.json'
    if not job.programs.succeeds('plumb-eval', 'compare', *files, *kinds, '--json', report):
        return None
    return json.loads(report.read_text())


def compare(job):
    names = [name for name in job.plan['drives'] if (job.out / 'runs' / name / 'default/0/truth.txt').exists()]
    found = []
    for title, measure, first, second in COMPARISONS:
        if not {first[0], second[0]} <= set(job.plan['modes']):
            continue
        # Without measured planes the constant is right by definition.
        fair = [name for name in names if second[1] != 'constant' or
                (job.out / 'runs' / name / 'default/0/planes.txt').exists()]
        groups = {POOLED: fair, **({name: [name] for name in fair} if len(fair) > 1 else {})}
        for group, members in groups.items():
            result = compare_on(job, members, measure, first, second)
            if result:
                found.append({'title': title, 'measure': measure, 'drives': group, **result})
    write_json(job.out / 'comparisons.json', found)
