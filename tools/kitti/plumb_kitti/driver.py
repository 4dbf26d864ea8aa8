"""tools/kitti/plumb-kitti: finds the drives, plans the jobs and lets Snakemake run them."""
import dataclasses
import fcntl
import os
import pathlib
import re
import shutil
import subprocess
import sys

from plumb_kitti import discover, jobs, keys, missing, page, plan, report
from plumb_tools import command_line
from plumb_tools.command_line import UsageError
from plumb_tools.programs import OUT, Programs, add_bin_option

SNAKEFILE = pathlib.Path(__file__).resolve().parents[1] / 'Snakefile'
PROGRAMS = ('plumb-kitti2lcm', 'plumb-convert', 'plumb-planes', 'plumb-trial', 'plumb-replay', 'plumb-eval', 'plumb-train', 'plumb-boxes')
STEPS = re.compile(r'^(\d+) of (\d+) steps')


def named_folder(text):
    """A type for add_argument(): NAME=FOLDER."""
    name, equals, path = text.partition('=')
    if not equals or not re.fullmatch(r'[A-Za-z0-9._-]+', name):
        raise command_line.argparse.ArgumentTypeError(f'{text} is not NAME=FOLDER')
    return name, command_line.folder(path).absolute()


def parse_options():
    parser = command_line.Parser('plumb-kitti')
    parser.add_argument('data', metavar='DIR', type=command_line.folder)
    parser.add_argument('--out', type=pathlib.Path, default=OUT / 'kitti')
    parser.add_argument('--trials', type=command_line.at_least(0), default=3)
    parser.add_argument('--modes', type=command_line.list_of(tuple(plan.MODES)),
                        default=['default', 'paper', 'paper-fixed'])
    parser.add_argument('--drives', type=lambda text: text.split(','))
    parser.add_argument('--jobs', type=command_line.at_least(1), default=os.cpu_count())
    parser.add_argument('--profile', type=command_line.folder)
    parser.add_argument('--boxes', type=named_folder, action='append', default=[])
    parser.add_argument('--others', type=named_folder, action='append', default=[])
    parser.add_argument('--detector', type=command_line.file)
    parser.add_argument('--dry', action='store_true')
    add_bin_option(parser)
    return parser.parse_args()


def chosen(drives, names):
    """The drives of these names, or all. Raises UsageError for an unknown name."""
    known = {drive.name: drive for drive in drives}
    for name in names or ():
        if name not in known:
            raise UsageError(f'--drives: no drive {name}' + command_line.did_you_mean(name, known))
    return [known[name] for name in names] if names else drives


def add_boxes(drives, boxes):
    for tracker, folder in boxes:
        for drive in drives:
            path = folder / f'{drive.name}.txt'
            if path.exists():
                drive.boxes[tracker] = str(path)


def trackers_of(folder, boxes):
    """{tracker: its folder} for a folder of tracking labels: what lies in its det2d, and what was named."""
    found = {path.name: str(path) for path in sorted(folder.glob('det2d/*')) if path.is_dir()}
    found.update({name: str(path) for name, path in boxes if any(path.glob('[0-9][0-9][0-9][0-9].txt'))})
    return found


def print_found(drives, rows):
    for drive in drives:
        facts = [word for word, there in (('truth', drive.has_truth), ('scans', drive.velodyne), ('planes', drive.planes),
                                          ('labels', drive.labels), ('for the server', drive.for_server)) if there]
        lacks = ', lacks ' + ' and '.join(drive.lacks) if drive.lacks else ''
        print(f"{drive.name:<28} {drive.kind:<9} {drive.num_images:5d} images  {', '.join(facts) or 'no truth'}{lacks}")
    for row in rows:
        print(f"missing for {row['section']}: {row['what']}; download {row['download']}")


def show_progress(text, line_before):
    """Shows the steps done on a terminal; returns the newest line."""
    match = STEPS.match(text)
    if not match or not sys.stderr.isatty():
        return line_before
    print(f'\r{match.group(1)} of {match.group(2)} jobs', end='', file=sys.stderr, flush=True)
    return text


def run_workflow(out, options, lock_handle):
    """Runs Snakemake and keeps what it says in OUT/workflow.log. Returns its exit code."""
    # Unlike Snakemake's own lock, the driver's goes with the processes that hold it. Snakemake holds it too, so that
    # nobody else begins while it outlives a driver that was killed. A job puts its output in place in one step, so one
    # that is there is whole, whatever Snakemake noted of it before it was killed.
    words = ['snakemake', '--snakefile', SNAKEFILE, '--directory', out, '--nolock', '--keep-going', '--ignore-incomplete',
             '--rerun-triggers', 'mtime', '--restart-times', '1']
    words += ['--profile', options.profile.resolve()] if options.profile else ['--cores', options.jobs]
    shown = ''
    with open(out / 'workflow.log', 'w') as log, subprocess.Popen(
            [str(word) for word in words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
            pass_fds=[lock_handle.fileno()]) as process:
        for line in process.stdout:
            log.write(line)
            log.flush()
            shown = show_progress(line, shown)
    if shown:
        print(file=sys.stderr)
    return process.returncode


def failed_jobs(out):
    """The jobs that the workflow gave up, with what they said, from its log."""
    found, job, reason = {}, None, ''
    for line in (out / 'workflow.log').read_text().splitlines():
        if line.startswith('job: '):
            reason = line.removeprefix('job: ')
        match = re.match(r'Error in rule (\w+):', line)
        if match:
            job = match.group(1)
        match = re.match(r'\s+output: (\S+)', line)
        if job and match:
            found[match.group(1)] = reason
            job, reason = None, ''
    return {path: why for path, why in found.items() if not (out / path).exists()}


def lock(out):
    """Holds OUT for this process. Raises UsageError when another one has it."""
    handle = open(out / '.lock', 'w')
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        handle.close()
        raise UsageError(f'{out} is in use by another plumb-kitti') from None
    return handle


def main():
    options = parse_options()
    drives, label_folders = discover.find(options.data.absolute())
    drives = chosen(drives, options.drives)
    add_boxes(drives, options.boxes)
    others = {name: {drive.name: str(folder / f'{drive.name}.txt') for drive in drives
                     if (folder / f'{drive.name}.txt').exists() and drive.has_truth} for name, folder in options.others}
    rows = missing.rows_of([dataclasses.asdict(drive) for drive in drives], label_folders, others)
    if options.dry:
        print_found(drives, rows)
        return 0
    if not shutil.which('snakemake'):
        raise UsageError('no snakemake: install the Debian package snakemake')
    Programs(options.bin, *PROGRAMS)
    if options.out.resolve().is_relative_to(options.data.resolve()):
        raise UsageError(f'--out {options.out} lies in DIR, which is only read')
    options.out.mkdir(parents=True, exist_ok=True)
    out = options.out.resolve()
    with lock(out) as lock_handle:
        usable = [dataclasses.asdict(drive) for drive in drives if not drive.lacks]
        trackers = {str(k): trackers_of(folder, options.boxes) for k, folder in enumerate(label_folders)}
        made = plan.make(usable, [str(folder) for folder in label_folders], options, trackers, others)
        plan.write({**made, 'missing': rows}, out / 'plan.json')
        keys.write(made, PROGRAMS, out)
        (out / 'report.json').unlink(missing_ok=True)  # so that results that were deleted are made again
        code = run_workflow(out, options, lock_handle)
        failed = failed_jobs(out) if code else {}
        if code:
            job = jobs.Job(out)
            page.bundle(job)
            report.report(job, failed)
    for path, why in failed.items():
        print(f'plumb-kitti: failed twice: {path}: {why}', file=sys.stderr)
    if code and not failed:
        raise UsageError(f'the workflow failed; see {out}/workflow.log')
    print(out / 'report.html')
    return 1 if failed else 0
