"""Runs every drive in every mode with every seed and finds the files that the runs leave."""
import json

from plumb_tools import drive_files
from plumb_tools.programs import is_newer, planes_of

MODES = {
    'default': '',
    'fixed': '[ground]\ncovariance = "fixed"\n',
    'paper': '[ground]\nmode = "paper"\n',
    'paper-fixed': '[ground]\nmode = "paper"\ncovariance = "fixed"\n',
    'paper-dense': '[ground]\nmode = "paper"\ncues = "dense"\n',
    'paper-points': '[ground]\nmode = "paper"\ncues = "points"\n',
}
LENGTHS = {'short': '10,20,50', 'long': 'new'}


class Bench:
    """The runs and their files below the folder `out`.

    `drives` holds folders by name, `modes` the text of a configuration by name.
    """

    def __init__(self, programs, out, drives, modes, num_seeds):
        self.programs, self.out, self.drives, self.modes = programs, out, drives, modes
        self.seeds = list(range(1, num_seeds + 1))
        for name in ('logs', 'config', 'pictures'):
            (out / name).mkdir(parents=True, exist_ok=True)
        for mode, text in modes.items():
            path = self.config(mode)
            if not path.exists() or path.read_text() != text:
                path.write_text(text)

    @property
    def first_seed(self):
        return self.seeds[0]

    def config(self, mode):
        return self.out / 'config' / f'{mode}.toml'

    def log(self, drive):
        return self.out / 'logs' / f'{drive}.lcm'

    def picture(self, name):
        return self.out / 'pictures' / f'{name}.png'

    def path(self, mode, seed, drive, end):
        """The path at which a run leaves the file whose name has this end."""
        folder = self.out / 'runs' / mode / str(seed)
        folder.mkdir(parents=True, exist_ok=True)
        return folder / (drive + end)

    def convert(self, drive):
        folder = self.drives[drive]
        if not is_newer(self.log(drive), folder / 'poses.txt'):
            self.programs.run('plumb-kitti2lcm', folder, '--out', self.log(drive))

    def measure(self, job):
        """Replays and evaluates one run. `job` is (mode, seed, drive)."""
        self._replay(*job)
        self._evaluate(*job)
        if job[1] == self.first_seed:
            self._sample(*job)

    def _replay(self, mode, seed, drive):
        poses = self.path(mode, seed, drive, '.txt')
        program = self.programs.path('plumb-replay')
        if is_newer(poses, self.log(drive), self.config(mode), program):
            return
        self.programs.run('plumb-replay', self.log(drive), '--poses', poses, '--csv',
                          self.path(mode, seed, drive, '.csv'), '--config', self.config(mode), '--seed', seed,
                          log=self.path(mode, seed, drive, '.replay.txt'))

    def _evaluate(self, mode, seed, drive):
        for kind, lengths in LENGTHS.items():
            self.programs.run('plumb-eval', self.drives[drive] / 'poses.txt', self.path(mode, seed, drive, '.txt'),
                              '--lengths', lengths, '--allow-partial', '--json',
                              self.path(mode, seed, drive, f'.{kind}.json'))
        planes = planes_of(self.drives[drive])
        if planes:  # this fails for a run without a single plane, which has nothing to compare
            self.programs.succeeds('plumb-eval', 'plane', planes, self.path(mode, seed, drive, '.csv'), '--json',
                                   self.path(mode, seed, drive, '.plane.json'))

    def _sample(self, mode, seed, drive):
        samples = self.path(mode, seed, drive, '.samples.csv')
        if not is_newer(samples, self.path(mode, seed, drive, '.txt')):
            self.programs.succeeds('plumb-train', 'sample', self.log(drive), '--out', samples, '--again', '--config',
                                   self.config(mode), '--seed', seed, '--drive', drive)

    def frames(self, mode, seed, drive):
        return drive_files.read_frames(self.path(mode, seed, drive, '.csv'))

    def report(self, mode, seed, drive, kind):
        """What plumb-eval said about a run ('short', 'long' or 'plane'); None when nothing."""
        path = self.path(mode, seed, drive, f'.{kind}.json')
        return json.loads(path.read_text()) if path.exists() else None

    def scores(self, mode):
        """What plumb-train says about a mode's variances, with one entry per drive and quantity."""
        files = [self.path(mode, self.first_seed, drive, '.samples.csv') for drive in self.drives]
        files = [file for file in files if file.exists()]
        out = self.out / 'runs' / mode / 'score.json'
        if not files or not self.programs.succeeds('plumb-train', 'score', *files, '--json', out):
            return []
        return json.loads(out.read_text())['outputs']
