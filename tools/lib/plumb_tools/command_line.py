"""Command lines of the Python tools: one sentence and exit code 2 for whatever is wrong.

The sentences have the form of the C++ programs' (platform/command_line.hpp): an unknown option or
value names the nearest known word, and an output that is an input or another output is refused
before anything is written.
"""
import argparse
import difflib
import os
import pathlib
import signal
import stat
import sys


MOST_LISTED_WORDS = 12  # more of them make no readable sentence


class UsageError(Exception):
    """What is wrong with the user's wishes or files, in one sentence."""


def run(program, main):
    """Calls main() and exits with what it returns, or with 2 after printing a UsageError.

    A reader that closes the pipe, or Ctrl-C, ends the script without a word.
    """
    for number in (signal.SIGPIPE, signal.SIGINT):
        signal.signal(number, signal.SIG_DFL)
    try:
        sys.exit(main())
    except UsageError as error:
        print(f'{program}: {error}', file=sys.stderr)
        sys.exit(2)
    except OSError as error:
        print(f'{program}: {error.filename}: {error.strerror}', file=sys.stderr)
        sys.exit(2)


def did_you_mean(word, known):
    """'; did you mean NEAREST?', or nothing when no known word is near."""
    near = difflib.get_close_matches(word, list(known), 1)
    return f'; did you mean {near[0]}?' if near else ''


class Parser(argparse.ArgumentParser):
    """Prints the script's docstring as help and raises UsageError for wrong command lines."""

    def __init__(self, program):
        super().__init__(prog=program, usage=argparse.SUPPRESS, add_help=False, allow_abbrev=False)
        self.add_argument('-h', '--help', action='store_true')

    def parse_args(self, args=None, namespace=None):
        words = sys.argv[1:] if args is None else args
        if '-h' in words or '--help' in words:
            print(sys.modules['__main__'].__doc__.strip())
            sys.exit(0)
        self._refuse_unknown_options(words)
        return super().parse_args(words, namespace)

    def error(self, message):
        message = message.removeprefix('argument ')
        name, _, rest = message.partition(': ')
        if rest.startswith('expected'):
            message = f'{name} wants a value'
        missing = 'the following arguments are required: '
        if message.startswith(missing):
            message = f'{message.removeprefix(missing)} is missing; see --help'
        raise UsageError(message.replace('unrecognized arguments:', 'unexpected argument'))

    def _refuse_unknown_options(self, words):
        for word in words:
            name = word.partition('=')[0]
            if not name.startswith('--') or name in self._option_string_actions:
                continue
            raise UsageError(f'unknown option {name}' +
                             (did_you_mean(name, self._option_string_actions) or '; see --help'))


def one_of(words):
    """A type for add_argument(): one of the words."""
    def check(text):
        if text in words:
            return text
        shown = ', '.join(words) if len(words) <= MOST_LISTED_WORDS else f'the {len(words)} known ones'
        raise argparse.ArgumentTypeError(f'{text} is none of {shown}' + did_you_mean(text, words))
    return check


def list_of(words):
    """A type for add_argument(): some of the words with commas between them."""
    check = one_of(words)
    return lambda text: [check(word) for word in text.split(',')]


def at_least(low, number_type=int):
    """A type for add_argument(): a number that is not below `low`."""
    def check(text):
        kind = 'whole number' if number_type is int else 'number'
        try:
            value = number_type(text)
        except ValueError:
            raise argparse.ArgumentTypeError(f'{text} is not a {kind}') from None
        if not value >= low:
            raise argparse.ArgumentTypeError(f'{text} is below {low}')
        return value
    return check


def folder(text):
    """A type for add_argument(): a folder that exists."""
    if os.path.isdir(text):
        return pathlib.Path(text)
    raise argparse.ArgumentTypeError(f'{text} is not a folder')


def file(text):
    """A type for add_argument(): a file that exists."""
    if os.path.exists(text) and not os.path.isdir(text):
        return pathlib.Path(text)
    raise argparse.ArgumentTypeError(f'no file {text}')


def refuse_overwriting(inputs, outputs):
    """Raises UsageError when an output is an input or another output.

    Both are {name: path}; a path of None is left out. Devices such as /dev/null are never refused.
    """
    seen = {name: path for name, path in inputs.items() if path}
    for name, path in outputs.items():
        if not path:
            continue
        for other, other_path in seen.items():
            if _same_file(path, other_path):
                raise UsageError(f'{name} {path} would overwrite {other} {other_path}')
        seen[name] = path


def _same_file(a, b):
    exist = os.path.exists(a), os.path.exists(b)
    if all(exist):
        return stat.S_ISREG(os.stat(a).st_mode) and os.path.samefile(a, b)
    return not any(exist) and os.path.realpath(a) == os.path.realpath(b)
