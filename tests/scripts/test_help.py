# SPDX-License-Identifier: MIT
"""Every Python script explains itself, whatever Python stands first in the PATH."""
import subprocess
import unittest

from support import SCRIPTS


def python_scripts():
    found = []
    for path in sorted([*SCRIPTS.iterdir(), *(SCRIPTS / "datasets").iterdir()]):
        if path.is_file() and path.read_bytes().startswith(b"#!") and b"python" in (
                path.read_bytes().partition(b"\n")[0]):
            found.append(path)
    return found


class HelpTest(unittest.TestCase):
    def test_help_needs_nothing_but_the_script(self):
        scripts = python_scripts()
        self.assertGreater(len(scripts), 10)
        for path in scripts:
            with self.subTest(path.name):
                done = subprocess.run([path, "--help"], capture_output=True, text=True, check=False,
                                      env={"PATH": "/nowhere", "PYTHONDONTWRITEBYTECODE": "1"})
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                self.assertIn("usage: ", done.stdout)

    def test_a_misspelt_option_is_told_the_right_one(self):
        for script, wrong, right in (("batch", "--lsit", "--list"),
                                     ("draw_run.py", "--evalution=x", "--evaluation")):
            done = subprocess.run([SCRIPTS / script, "there", wrong], capture_output=True, text=True,
                                  check=False)
            self.assertEqual(done.returncode, 1)
            self.assertIn(f"unrecognized arguments: {wrong}; did you mean {right}?\n", done.stderr)


if __name__ == "__main__":
    unittest.main()
