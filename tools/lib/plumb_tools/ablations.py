"""Writes configurations that leave out one part each: the tool tools/evaluate/ablations."""
import pathlib
import re

from plumb_tools import command_line
from plumb_tools.command_line import UsageError
from plumb_tools.programs import ROOT

DISTRUST = {'low_std': 10.0, 'high_std': 10.0}

# name: (changes to the model by section, lines of the configuration's section [ground])
ABLATIONS = {
    'one-plane': ({'bend': {'start_std': 0.0}}, ''),
    'without-travel': ({'travel': DISTRUST}, ''),
    'without-points': ({'points': DISTRUST}, ''),
    'without-dense': ({name: DISTRUST for name in ('dense_height', 'dense_n1', 'dense_n3')}, ''),
    'without-memory': ({'memory': {'dense_ratio': 0.0, 'points_ratio': 0.0}}, ''),
    'without-objects': ({}, 'detections_delay_images = 0'),
    'near-road': ({}, 'road_far_m = 12.0'),
    'far-road': ({}, 'road_far_m = 35.0'),
}


def changed(model, changes):
    """The model file's text with `changes[section][key]` in place of its numbers.

    Raises UsageError when the model has no such key.
    """
    section, lines = '', []
    left = {(name, key) for name, keys in changes.items() for key in keys}
    for line in model.splitlines():
        header = re.match(r'\[(\w+)\]', line)
        section = header.group(1) if header else section
        key = line.split(' = ')[0]
        if (section, key) in left:
            line = f'{key} = {changes[section][key]!r}'
            left.remove((section, key))
        lines.append(line)
    if left:
        missing = ', '.join('.'.join(pair) for pair in sorted(left))
        raise UsageError(f'config/ground_model.toml has no {missing}')
    return '\n'.join(lines) + '\n'


def main():
    parser = command_line.Parser('ablations')
    parser.add_argument('folder', metavar='DIR', type=pathlib.Path)
    out = parser.parse_args().folder.absolute()
    out.mkdir(parents=True, exist_ok=True)
    model = (ROOT / 'config/ground_model.toml').read_text()
    modes = []
    for name, (changes, lines) in ABLATIONS.items():
        model_path, config_path = out / f'{name}.model.toml', out / f'{name}.toml'
        model_path.write_text(changed(model, changes))
        config_path.write_text(f'[ground]\nmodel_file = "{model_path}"\n{lines}\n')
        modes.append(f'{name}={config_path}')
    print(','.join(modes))
