"""Renders the drives of a list with plumb-synth: the tool tools/learn/render_drives."""
import pathlib

from plumb_tools import command_line
from plumb_tools.command_line import UsageError
from plumb_tools.programs import Programs, add_bin_option

POSES_PREFIX = 'POSES/'


def read_list(path):
    """{drive: options of plumb-synth as text} of lines 'NAME OPTIONS...'; # begins a comment."""
    drives = {}
    for number, line in enumerate(path.read_text().splitlines(), 1):
        if not line.strip() or line.startswith('#'):
            continue
        name, _, options = line.strip().partition(' ')
        if name in drives:
            raise UsageError(f'{path}:{number}: a second drive {name}')
        drives[name] = options.strip()
    return drives


def synth_options(name, options, poses_folder):
    """The options as words, with the folder in place of POSES. Raises UsageError."""
    words = options.split()
    for i, word in enumerate(words):
        if not word.startswith(POSES_PREFIX):
            continue
        if poses_folder is None:
            raise UsageError(f'{name} follows a file of KITTI poses: --poses is missing; see --help')
        path = poses_folder / word.removeprefix(POSES_PREFIX)
        if not path.is_file():
            raise UsageError(f'{name}: no file {path}')
        words[i] = str(path)
    return words


def render(name, options, words, out, programs):
    """Renders a drive unless it is there, complete and of the same options."""
    stamp = out / name / 'rendered.txt'
    if stamp.exists() and stamp.read_text().strip() == options:
        return
    print(f'{name}: {options}', flush=True)
    programs.run('plumb-synth', '--out', out / name, '--force', '--quiet', *words)
    stamp.write_text(options + '\n')


def main():
    parser = command_line.Parser('render_drives')
    parser.add_argument('list', metavar='LIST', type=command_line.file)
    parser.add_argument('names', metavar='NAME', nargs='*')
    parser.add_argument('--out', type=pathlib.Path, required=True)
    parser.add_argument('--poses', type=command_line.folder)
    add_bin_option(parser)
    options = parser.parse_args()
    programs = Programs(options.bin, 'plumb-synth')
    drives = read_list(options.list)
    for name in options.names:
        if name not in drives:
            raise UsageError(f'no drive {name} in {options.list}' + command_line.did_you_mean(name, drives))
    words = {name: synth_options(name, drives[name], options.poses) for name in options.names or drives}
    for name in words:
        render(name, drives[name], words[name], options.out, programs)
