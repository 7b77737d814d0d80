# SPDX-License-Identifier: MIT
"""The table of covariances takes what a run left only if the run ended well."""
import json
import pathlib
import unittest

from support import FolderTest

try:
    import covariance_table
except ImportError:
    covariance_table = None

# Ends well, and says so; notes that it was called.
PRETENDED = """#!/bin/sh
echo "$0" >> "$(dirname "$0")/calls.txt"
for argument in "$@"; do
  case "$argument" in --output=*) mkdir -p "${argument#--output=}"; cd "${argument#--output=}" ;; esac
done
echo '{"exit": {"code": 0}}' > run.json
"""


@unittest.skipIf(covariance_table is None, "python3-numpy and python3-scipy are not installed")
class MakeRunTest(FolderTest):
    def setUp(self):
        super().setUp()
        for name in ("trajlo_simulate", "trajlo_run"):
            self.executable(f"apps/{name}", PRETENDED)

    def calls(self):
        """The programs that were called for a run."""
        noted = self.folder / "apps" / "calls.txt"
        noted.unlink(missing_ok=True)
        covariance_table.make_run(self.folder / "apps", self.folder, "hall_os1_16", "at rest", 1)
        return [pathlib.Path(line).name for line in noted.read_text().splitlines()] \
            if noted.exists() else []

    def test_a_run_that_ended_well_is_not_made_again(self):
        self.assertEqual(self.calls(), ["trajlo_simulate", "trajlo_run"])
        self.assertEqual(self.calls(), [])

    def test_a_run_in_doubt_counts_as_well(self):
        self.write("result/run.json", json.dumps({"exit": {"code": 3}}))
        self.assertEqual(self.calls(), [])

    def test_a_run_that_was_interrupted_or_failed_is_made_again(self):
        for code in (None, 4, 130):
            with self.subTest(code=code):
                self.write("result/run.json", json.dumps({"exit": {"code": code}}))
                self.assertEqual(self.calls(), ["trajlo_simulate", "trajlo_run"])
        self.write("result/run.json", '{"exit": ')
        self.assertEqual(self.calls(), ["trajlo_simulate", "trajlo_run"])

    def test_the_build_is_the_one_that_the_environment_names(self):
        self.assertTrue(self.called_in_build_dir("covariance_table.py", "trajlo_simulate",
                                                 "--output=out"))


if __name__ == "__main__":
    unittest.main()
