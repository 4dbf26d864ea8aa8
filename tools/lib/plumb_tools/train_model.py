"""Trains a model of cue variances in three rounds: the tool tools/learn/train_model."""
import concurrent.futures
import os
import pathlib

from plumb_tools import command_line
from plumb_tools.command_line import UsageError
from plumb_tools.programs import OUT, Counter, Programs, add_bin_option, find_drives, is_newer


class Trainer:
    """Samples and fits below the folder `out`. `hold_out` names drives to score but not to fit."""

    def __init__(self, programs, out, drives, hold_out, num_jobs):
        self.programs, self.out, self.drives, self.num_jobs = programs, out, drives, num_jobs
        self.hold_out = [word for name in hold_out for word in ('--hold-out', name)]
        (out / 'logs').mkdir(parents=True, exist_ok=True)

    def convert(self):
        for name, folder in self.drives.items():
            log = self.log(name)
            if not is_newer(log, folder / 'poses.txt'):
                self.programs.run('plumb-kitti2lcm', folder, '--out', log)

    def log(self, drive):
        return self.out / 'logs' / f'{drive}.lcm'

    def sample(self, name, settings):
        """Samples every drive with these settings of [ground]; returns the files."""
        folder, config = self.out / name, self.out / f'{name}.toml'
        folder.mkdir(exist_ok=True)
        config.write_text(f'[ground]\n{settings}\n')
        files = {drive: folder / f'{drive}.csv' for drive in self.drives}
        counter = Counter(len(files), f'drives sampled, round {name}')

        def sample_drive(drive):
            self.programs.run('plumb-train', 'sample', self.log(drive), '--out', files[drive], '--config', config,
                              '--drive', drive, '--again')

        with concurrent.futures.ThreadPoolExecutor(self.num_jobs) as pool:
            for _ in pool.map(sample_drive, files):
                counter.step()
        return list(files.values())

    def fit(self, name, samples, model, *options):
        """Fits a model to the samples; what plumb-train prints goes to NAME.txt and is returned."""
        return self.programs.run('plumb-train', 'fit', *samples, *self.hold_out, '--out', model, *options,
                                 log=self.out / f'{name}.txt')


def train(trainer):
    """The three rounds; prints the last one's scores."""
    out = trainer.out
    first, second, model = out / 'first_model.toml', out / 'second_model.toml', out / 'model.toml'
    plots = ('--plots', out / 'plots')
    trainer.fit('first', trainer.sample('first', 'covariance = "fixed"'), first)
    trainer.fit('second', trainer.sample('second', f'model_file = "{first}"'), second, '--start', first, '--json',
                out / 'second.json', *plots)
    print(trainer.fit('third', trainer.sample('third', f'model_file = "{second}"'), model, '--plane-only',
                      '--start', second, '--json', out / 'model.json', *plots), end='')


def train_paper(trainer):
    """Adds the published method's lines to the model."""
    out = trainer.out
    fitted = out / 'paper_model.toml'
    print(trainer.fit('paper', trainer.sample('paper', 'mode = "paper"'), fitted, '--start', out / 'model.toml',
                      '--plots', out / 'plots'), end='')
    fitted.replace(out / 'model.toml')


def main():
    parser = command_line.Parser('train_model')
    parser.add_argument('folders', metavar='DRIVES_DIR', nargs='+', type=command_line.folder)
    parser.add_argument('--out', type=pathlib.Path, default=OUT / 'train')
    parser.add_argument('--jobs', type=command_line.at_least(1), default=os.cpu_count())
    parser.add_argument('--hold-out', action='append', default=[])
    parser.add_argument('--paper', action='store_true')
    add_bin_option(parser)
    options = parser.parse_args()
    drives = find_drives(*options.folders)
    for name in options.hold_out:
        if name not in drives:
            raise UsageError(f"--hold-out: no drive {name}" + command_line.did_you_mean(name, drives))
    programs = Programs(options.bin, 'plumb-kitti2lcm', 'plumb-train')
    trainer = Trainer(programs, options.out.absolute(), drives, options.hold_out, options.jobs)
    trainer.convert()
    train(trainer)
    if options.paper:
        train_paper(trainer)
