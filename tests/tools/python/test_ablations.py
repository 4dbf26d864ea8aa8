"""Tests tools/evaluate/ablations, which writes configurations with one part left out."""
import pathlib
import tomllib
import unittest

import support
from plumb_tools import ablations
from plumb_tools.command_line import UsageError

MODEL = '[model]\na = 1\n[travel]\nlow_std = 0.1  # small\nhigh_std = 0.2\n[dense]\nlow_std = 0.3\n'


class Changed(unittest.TestCase):
    def test_replaces_numbers_in_their_section_alone(self):
        changed = tomllib.loads(ablations.changed(MODEL, {'travel': {'low_std': 10.0}}))
        self.assertEqual(changed['travel'], {'low_std': 10.0, 'high_std': 0.2})
        self.assertEqual(changed['dense'], {'low_std': 0.3})

    def test_refuses_a_key_that_the_model_lacks(self):
        with self.assertRaisesRegex(UsageError, 'has no bend.start_std'):
            ablations.changed(MODEL, {'bend': {'start_std': 0.0}})


class Ablations(support.FolderTest):
    def test_writes_a_configuration_per_part_of_the_shipped_model(self):
        code, out, err = self.run_script('evaluate/ablations', self.folder / 'new')
        self.assertEqual(code, 0, err)
        modes = dict(word.split('=') for word in out.strip().split(','))
        self.assertEqual(set(modes), set(ablations.ABLATIONS))
        for name, path in modes.items():
            ground = tomllib.loads(pathlib.Path(path).read_text())['ground']
            model = tomllib.loads(pathlib.Path(ground['model_file']).read_text())
            for section, keys in ablations.ABLATIONS[name][0].items():
                for key, value in keys.items():
                    self.assertEqual(model[section][key], value)


if __name__ == '__main__':
    unittest.main()
