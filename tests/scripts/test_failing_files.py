# SPDX-License-Identifier: MIT
"""What cannot be read or written ends with one sentence and its exit code, in every script that
draws."""
import errno
import os
import pathlib
import subprocess
import unittest
import unittest.mock

from evaluation_folder import write_evaluation
from result_folder import write_result
from support import SCRIPTS, FolderTest

from trajlo_report import command_line, files

POSE = "{} 0 0 0 0 0 0 1\n"


class FailingFilesTest(FolderTest):
    def refuse(self, code, said, script, *arguments):
        done = subprocess.run([SCRIPTS / script, *arguments], capture_output=True, text=True,
                              check=False)
        self.assertEqual((done.returncode, done.stdout), (code, ""), done.stderr)
        self.assertEqual(done.stderr, f"{script}: {said}\n")

    def setUp(self):
        super().setUp()
        self.file = self.write("file", "")
        self.inside = self.file / "folder"
        self.truth = self.write("truth.tum", POSE.format(0) + POSE.format(1))

    def test_a_folder_that_cannot_be_written_ends_with_5(self):
        why = "cannot be written: not a directory; a part of the path is a file, so name another"
        figures = f"{self.inside / 'figures'} {why}"
        result, evaluation = self.folder / "result", self.folder / "evaluation"
        write_result(result)
        write_evaluation(evaluation, {"one": 0.01})
        self.refuse(5, figures, "draw_run.py", result, "--output", self.inside)
        self.refuse(5, figures, "draw_evaluation.py", evaluation, "--output", self.inside)
        self.refuse(5, f"{self.inside / 's.svg'} {why}", "draw_speeds.py", self.inside / "s.svg",
                    f"truth={self.truth}")
        comparison = self.write("comparison/comparison.json", '{"variants": []}').parent
        self.write("comparison/figures", "")
        self.refuse(5, f"{comparison / 'figures'} cannot be written: file exists; a file is in the "
                    "place of a folder, so name another", "draw_comparison.py", comparison)
        first = self.inside / "at_rest" / "hall_os1_16-s1"
        self.refuse(5, f"{first} {why}", "covariance_table.py", "--output", self.inside)

    def test_so_do_batches_experiments_and_campaigns(self):
        build = self.pretend_build()
        suite = self.write("s.yaml", "sequences:\n  - simulate: hall_os1_16\n"
                           "configurations:\n  - name: plain\n")
        experiment = self.write("e.yaml", "design: {kind: grid}\nvary: {window.segments: [3]}\n"
                                "sequences:\n  - simulate: hall_os1_16\n")
        for script, *arguments in (("batch", suite), ("batch", suite, "--report"),
                                   ("experiment", experiment), ("experiment", experiment, "--report"),
                                   ("fault_campaign", "--runs", "1"), ("soak",)):
            with self.subTest(script):
                self.refuse(5, f"{self.inside} cannot be written: not a directory; a part of the "
                            "path is a file, so name another", script, *arguments, "--build",
                            build, "--output", self.inside)

    def test_a_file_that_cannot_be_read_ends_with_2(self):
        missing = self.folder / "nothere"
        said = f"{missing} cannot be read: no such file or directory; check the path"
        self.refuse(2, said, "draw_speeds.py", self.folder / "s.svg", f"truth={missing}")
        trajectory = self.folder / "trajectory.tum"
        self.refuse(2, f"{trajectory} cannot be read: no such file or directory; check the path",
                    "check_covariance.py", f"{self.folder}={self.truth}")
        self.refuse(2, f"{missing / 'comparison.json'} is missing", "draw_comparison.py", missing)

    def test_an_output_that_nobody_reads_ends_with_5_and_in_silence(self):
        read, write = os.pipe()
        os.close(read)
        with os.fdopen(write) as nobody:
            done = subprocess.run([SCRIPTS / "experiment", "weights", "--list"], stdout=nobody,
                                  stderr=subprocess.PIPE, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (5, ""))

    def test_wrong_usage_ends_with_1(self):
        for figure, named, said in (("s.jpg", "truth=t", "'s.jpg' does not end in .svg, .pdf or"),
                                    ("s.svg", "truth", "'truth' is not NAME=FILE")):
            done = subprocess.run([SCRIPTS / "draw_speeds.py", figure, named], capture_output=True,
                                  text=True, check=False)
            self.assertEqual(done.returncode, 1)
            self.assertIn(said, done.stderr)

    def test_a_full_disk_is_told_with_the_file(self):
        full = OSError(errno.ENOSPC, "No space left on device")
        with unittest.mock.patch.object(pathlib.Path, "write_text", side_effect=full):
            with self.assertRaises(files.WriteError) as caught:
                files.write_atomically(self.folder / "page.html", "")
        self.assertEqual(command_line.sentence(caught.exception, "be written"),
                         f"{self.folder / 'page.html'} cannot be written: no space left on device; "
                         "free some space")


if __name__ == "__main__":
    unittest.main()
