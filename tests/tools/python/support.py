"""Has what the tests of the Python tools share: the package's path, temporary folders, scripts."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / 'tools/lib'))


class FolderTest(unittest.TestCase):
    """A test with a temporary folder."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def run_script(self, script, *arguments):
        """Runs a script in tools/. Returns (exit code, stdout, stderr)."""
        done = subprocess.run([ROOT / 'tools' / script, *map(str, arguments)], capture_output=True, text=True)
        return done.returncode, done.stdout, done.stderr

    def assert_refused(self, script, arguments, sentence):
        """Expects that the script ends with code 2 and one line on stderr that has the sentence."""
        code, out, err = self.run_script(script, *arguments)
        self.assertEqual((code, out), (2, ''), err)
        self.assertEqual(err.count('\n'), 1, err)
        self.assertIn(sentence, err)

    def fake_program(self, name, text):
        """Writes a shell script that stands in for a plumb-* program."""
        path = self.write(f'bin/{name}', '#!/bin/sh\n' + text + '\n')
        os.chmod(path, 0o755)
        return path
