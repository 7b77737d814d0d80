# SPDX-License-Identifier: MIT
"""A whole experiment on short simulated recordings: it survives its killing and ends in a page,
and any of its rows can be repeated."""
import csv
import os
import pathlib
import signal
import subprocess
import time
import unittest

from support import SCRIPTS, FolderTest, built

EXPERIMENT = """
title: Two windows on two flights
design: {kind: grid}
vary:
  window.segments: [2, 4]
defaults: {duration_s: 2, seeds: [1, 2]}
sequences:
  - simulate: hall_os1_16
"""
# Stands before the real program and gives the test the time to kill.
SLOW = """#!/bin/sh
case "$*" in
  *--show_config*|*--version*) ;;
  *) sleep 1 ;;
esac
exec {program} "$@"
"""


class ExperimentRunTest(FolderTest):
    def setUp(self):
        super().setUp()
        self.output = self.folder / "out"
        (self.folder / "build" / "apps").mkdir(parents=True)
        for name in ("trajlo_simulate", "trajlo_evaluate"):
            (self.folder / "build" / "apps" / name).symlink_to(built(name))
        self.executable("build/apps/trajlo_run", SLOW.format(program=built("trajlo_run")))

    def command(self, *arguments, text=EXPERIMENT):
        return [SCRIPTS / "experiment", self.write("short.yaml", text), "--output", self.output,
                "--build", self.folder / "build", *arguments]

    def experiment(self, *arguments, text=EXPERIMENT):
        return subprocess.run(self.command(*arguments, text=text), capture_output=True, text=True,
                              check=False)

    def statuses(self):
        """What every finished run wrote, and when."""
        return {path: (path.stat().st_mtime_ns, path.read_text())
                for path in self.output.glob("*/*/status.json")}

    def test_a_killed_experiment_goes_on_and_any_row_can_be_repeated(self):
        process = subprocess.Popen(self.command("-j", "1"), stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
        while not self.statuses() and process.poll() is None:
            time.sleep(0.02)
        os.kill(process.pid, signal.SIGKILL)
        process.wait()
        before = self.statuses()
        self.assertTrue(0 < len(before) < 4, "the experiment was to be killed in its middle")

        done = self.experiment("-j", "2")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("4 runs of 2 points: 4 ended well", done.stdout)
        after = self.statuses()
        self.assertEqual(len(after), 4)
        for path, status in before.items():
            self.assertEqual(after[path], status)
        # Two recordings for four runs.
        self.assertEqual(len(list(self.output.glob("recordings/*/rig.yaml"))), 2)
        with (self.output / "results.csv").open() as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["window.segments"] for row in rows], ["2", "2", "4", "4"])
        self.assertTrue(all(0 < float(row["ate_rmse_m"]) < 0.5 for row in rows))
        self.assertTrue(all((self.output / row["config"]).is_file() for row in rows))
        self.assertTrue((self.output / "figures" / "sensitivity.svg").is_file())
        self.assert_self_contained(self.output / "report.html")

        self.repeat(rows[2])
        more = self.experiment(text=EXPERIMENT.replace("[2, 4]", "[2, 3, 4]"))
        self.assertEqual(more.returncode, 0, more.stderr)
        self.assertEqual({path: self.statuses()[path] for path in after}, after)
        self.assertEqual(len(self.statuses()), 6)

    def repeat(self, row, text=EXPERIMENT):
        """The printed command gives the same trajectory to the last bit, and evaluates it."""
        printed = self.experiment("--command", row["row"], text=text).stdout
        again = self.folder / "again"
        again.mkdir()
        done = subprocess.run(printed, shell=True, cwd=again, capture_output=True, text=True,
                              check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        folder = again / f"row-{row['row']}"
        first = (self.output / row["config"]).parent / "trajectory.tum"
        self.assertEqual((folder / "trajectory.tum").read_bytes(), first.read_bytes())
        self.assertTrue((folder / "evaluation" / "evaluation.json").is_file())

    def test_runs_that_fail_are_results_and_recordings_can_be_dropped(self):
        text = EXPERIMENT.replace("  window.segments: [2, 4]", "  way:\n    settings:\n"
                                  "      good: {}\n      impossible: {input.start_s: 100}")
        done = self.experiment("--drop-recordings", text=text)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        # The body hardly moves in 2 s, so there may be warnings about the comparison.
        self.assertRegex(done.stdout, r"2 ended well( \(.*\))?, 2 with an x")
        with (self.output / "results.csv").open() as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([(row["way"], row["result"], row["exit_code"]) for row in rows], [
            ("good", "ok", "0"), ("good", "ok", "0"),
            ("impossible", "x", "2"), ("impossible", "x", "2")])
        self.assertEqual(list(pathlib.Path(self.output / "recordings").glob("*/")), [])
        self.repeat(rows[0], text)


if __name__ == "__main__":
    unittest.main()
