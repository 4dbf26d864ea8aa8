"""The plumb-* programs as the Python tools call them, and the drives they are called for."""
import os
import pathlib
import subprocess
import sys

from plumb_tools.command_line import UsageError, folder

ROOT = pathlib.Path(__file__).resolve().parents[3]
OUT = ROOT / 'out'


def add_bin_option(parser):
    """--bin DIR: where the programs are."""
    parser.add_argument('--bin', type=folder, default=ROOT / 'build/release/bin')


class Programs:
    """Runs the programs of one folder."""

    def __init__(self, bin_dir, *names):
        """Raises UsageError when one of the named programs is not there."""
        self.bin_dir = pathlib.Path(bin_dir)
        for name in names:
            if not os.access(self.bin_dir / name, os.X_OK):
                raise UsageError(f'no {name} in {self.bin_dir}: build first (tools/test does)')

    def path(self, name):
        return self.bin_dir / name

    def run(self, name, *arguments, log=None):
        """Runs a program and returns what it prints, which also goes to the file `log`.

        Raises UsageError with the program's last line on stderr when it fails.
        """
        words = [str(word) for word in (self.path(name), *arguments)]
        done = subprocess.run(words, capture_output=True, text=True)
        if log:
            pathlib.Path(log).write_text(done.stdout)
        if done.returncode != 0:
            lines = (done.stderr or done.stdout).strip().splitlines()
            raise UsageError(f'{name} failed with {done.returncode}: {lines[-1] if lines else words}')
        return done.stdout

    def succeeds(self, name, *arguments):
        """Runs a program that may fail; True when it did not."""
        try:
            self.run(name, *arguments)
        except UsageError:
            return False
        return True


def is_newer(path, *inputs):
    """Whether `path` exists and is not older than any of the inputs."""
    return os.path.exists(path) and all(
        os.path.getmtime(path) >= os.path.getmtime(other) for other in inputs)


def find_drives(*roots):
    """{name: folder} of every KITTI drive with true poses below the folders, sorted by name.

    A drive is a folder with image_0 (or image_00) and poses.txt. Drives without poses.txt are
    named on stderr. Raises UsageError when there is none, or when two have the same name.
    """
    found = {}
    for root in roots:
        for path, names, _ in sorted(os.walk(root, followlinks=True)):
            if not {'image_0', 'image_00'} & set(names):
                continue
            drive = pathlib.Path(path)
            if not (drive / 'poses.txt').exists():
                print(f'{drive.name}: no poses.txt, passed over', file=sys.stderr)
                continue
            if drive.name in found:
                raise UsageError(f'two drives are named {drive.name}')
            found[drive.name] = drive
    if not found:
        raise UsageError('no drive (a folder with image_0 or image_00, and poses.txt) below ' +
                         ' '.join(map(str, roots)))
    return dict(sorted(found.items()))


def planes_of(drive):
    """The file of the drive's true ground planes, or None."""
    return next(iter(sorted(drive.glob('gt_ground_plane*.txt'))), None)


class Counter:
    """Counts finished jobs on stderr when that is a terminal."""

    def __init__(self, total, what):
        self.total, self.what, self.done = total, what, 0

    def step(self):
        self.done += 1
        if sys.stderr.isatty():
            end = '\n' if self.done == self.total else ''
            print(f'\r{self.done} of {self.total} {self.what}', end=end, file=sys.stderr, flush=True)
