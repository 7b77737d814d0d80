# SPDX-License-Identifier: MIT
"""Whole batches of short simulated recordings: they end, survive their killing, and go on."""
import csv
import json
import os
import pathlib
import signal
import subprocess
import time
import unittest

from support import ROOT, SCRIPTS, FolderTest, built

from trajlo_batch.suite import read_suite

SUITE = """
title: Two short flights
defaults: {duration_s: 3, seeds: [1, 2]}
sequences:
  - simulate: hall_os1_16
configurations:
  - name: plain
"""
FAILING = """
  - name: impossible
    set: {input.stamps_file: no_stamps.txt}
  - name: crashing
    set: {window.segments: 2}
"""
# Stands before the real program and crashes where the test wants it.
CRASHING = """#!/bin/sh
case "$*" in
  *--show_config*|*--version*) ;;
  *window.segments=2*) kill -SEGV $$ ;;
  *) {wait} ;;
esac
exec {program} "$@"
"""


def processes_with(text):
    """Numbers of the processes that have this text in their command line."""
    found = []
    for entry in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            command = (entry / "cmdline").read_bytes().decode(errors="replace")
        except OSError:
            continue
        if text in command and int(entry.name) != os.getpid():
            found.append(int(entry.name))
    return found


class HalvesTest(unittest.TestCase):
    def test_every_scenario_of_the_simulator_is_in_a_half(self):
        listed = subprocess.run([built("trajlo_simulate"), "--list"], capture_output=True,
                                text=True, check=True).stdout
        halves = [item.scenario for name in ("choose", "confirm")
                  for item in read_suite(ROOT / "config" / "suites" / f"{name}.yaml").sequences]
        self.assertEqual({line.split()[0] for line in listed.splitlines()}, set(halves))


class BatchTest(FolderTest):
    def setUp(self):
        super().setUp()
        self.output = self.folder / "out"
        self.prepare_build()

    def prepare_build(self, wait=":"):
        apps = self.folder / "build" / "apps"
        apps.mkdir(parents=True, exist_ok=True)
        for name in ("trajlo_simulate", "trajlo_evaluate"):
            if not (apps / name).exists():
                (apps / name).symlink_to(built(name))
        self.executable("build/apps/trajlo_run",
                        CRASHING.format(wait=wait, program=built("trajlo_run")))

    def command(self, suite, *arguments):
        return [SCRIPTS / "batch", self.write("short.yaml", suite), "--output", self.output,
                "--build", self.folder / "build", *arguments]

    def batch(self, suite, *arguments):
        done = subprocess.run(self.command(suite, *arguments), capture_output=True, text=True,
                              check=False)
        log = self.output / "snakemake.log"
        done.log = done.stdout + done.stderr + (log.read_text() if log.is_file() else "")
        return done

    def runs_that_never_end(self):
        """Says where a run tells that it has begun."""
        begun = self.folder / "begun"
        self.prepare_build(wait=f"touch {begun}; exec sleep 100000")
        return begun

    def start(self, *arguments, stderr=subprocess.DEVNULL):
        """A batch in the background. When the test ends it is killed, and its folder may go only
        when nothing that it had started is left to write into it."""
        process = subprocess.Popen(self.command(*arguments), stdout=subprocess.DEVNULL,
                                   stderr=stderr, text=True)
        self.addCleanup(self.wait_until_nothing_is_left)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def wait_until_nothing_is_left(self):
        """Waits as long as it takes: on a busy machine even killed processes need time to end."""
        while processes_with(str(self.output)):
            time.sleep(0.05)

    def statuses(self):
        return {path.parent.name + "/" + path.parent.parent.name: json.loads(path.read_text())
                for path in self.output.glob("*/*/status.json")}

    def rows(self):
        with (self.output / "results.csv").open() as file:
            return list(csv.DictReader(file))

    def test_a_killed_batch_goes_on_and_does_not_repeat_what_is_done(self):
        self.prepare_build(wait="sleep 1")
        process = self.start(SUITE, "-j", "1")
        while not self.statuses() and process.poll() is None:
            time.sleep(0.02)
        process.kill()
        process.wait()
        before = self.statuses()
        self.assertEqual(len(before), 1, "the batch was to be killed between its two runs")
        # Its jobs die with it: nothing is left that would write into what the next batch does.
        self.wait_until_nothing_is_left()
        self.assertEqual(self.statuses(), before)

        done = self.batch(SUITE, "-j", "2")
        self.assertEqual(done.returncode, 0, done.log)
        after = self.statuses()
        self.assertEqual(len(after), 2)
        for name, status in before.items():
            self.assertEqual(after[name], status)
        self.assertEqual([row["result"] for row in self.rows()], ["ok", "ok"])
        self.assertTrue(all(0 < float(row["ate_rmse_m"]) < 0.5 for row in self.rows()))
        self.assert_self_contained(self.output / "report.html")
        for row in self.rows():
            page = f"{row['folder']}/page/run.html"
            self.assertIn(f'href="{page}"', (self.output / "report.html").read_text())
            self.assert_self_contained(self.output / page)
            self.assertIn("Hall, OS1-16, seed", (self.output / page).read_text())

        self.assertEqual(self.batch(SUITE).returncode, 0)
        self.assertEqual(self.statuses(), after)

        changed = self.batch(SUITE + "    set: {window.segments: 3}\n")
        self.assertEqual(changed.returncode, 0, changed.log)
        self.assertEqual(len(list((self.output / "replaced" / "plain").iterdir())), 2)
        self.assertNotEqual(self.statuses(), after)

        # Another simulator: new recordings, and new runs of them.
        simulator = self.folder / "build" / "apps" / "trajlo_simulate"
        simulator.unlink()
        simulator.write_bytes(pathlib.Path(built("trajlo_simulate")).read_bytes() + b"newer")
        simulator.chmod(0o755)
        newer = self.batch(SUITE + "    set: {window.segments: 3}\n")
        self.assertEqual(newer.returncode, 0, newer.log)
        self.assertEqual(len(list((self.output / "replaced" / "plain").iterdir())), 4)
        self.assertEqual([row["result"] for row in self.rows()], ["ok", "ok"])

    def test_runs_that_fail_are_an_x_and_the_batch_goes_on(self):
        suite = SUITE.replace("[1, 2]", "[1]") + FAILING
        self.write("no_stamps.txt", "not a number\n")
        done = self.batch(suite, "--only", "plain/*")
        self.assertEqual(done.returncode, 0, done.log)  # the others were not asked for
        self.assertEqual(sorted(row["result"] for row in self.rows()),
                         ["not asked for", "not asked for", "ok"])
        done = self.batch(suite, "--drop-recordings")
        self.assertEqual(done.returncode, 3, done.log)
        rows = {row["configuration"]: row for row in self.rows()}
        self.assertEqual({name: row["result"] for name, row in rows.items()},
                         {"plain": "ok", "impossible": "x", "crashing": "x"})
        self.assertEqual(rows["impossible"]["exit_code"], "2")
        self.assertIn("no_stamps.txt", rows["impossible"]["reason"])
        self.assertEqual(rows["crashing"]["exit_code"], str(-signal.SIGSEGV))
        self.assertIn("crashed: SIGSEGV", rows["crashing"]["reason"])
        table = (self.output / "table.md").read_text()
        self.assertEqual(table.splitlines()[4].count(" × "), 2)
        self.assert_self_contained(self.output / "report.html")

        # The recording went with its last run; the printed command makes it again.
        self.assertFalse((self.output / "recordings" / "hall_os1_16-seed1").exists())
        command = rows["plain"]["command"]
        repeated = subprocess.run(command, shell=True, cwd=self.folder, capture_output=True,
                                  text=True, check=False)
        self.assertEqual(repeated.returncode, 0, repeated.stderr)
        again = self.folder / "hall_os1_16-seed1-again" / "trajectory.tum"
        first = self.output / "plain" / "hall_os1_16-seed1" / "result" / "trajectory.tum"
        self.assertEqual(again.read_bytes(), first.read_bytes())

    def test_a_pattern_that_matches_no_run_is_an_error_also_without_data(self):
        kitti = (ROOT / "config" / "suites" / "kitti.yaml").read_text()
        nothing = ("--data", self.folder / "nothing")
        for more in ((), ("--list",)):
            done = self.batch(kitti, *nothing, "--only", "trjalo/*", *more)
            self.assertEqual(done.returncode, 1, done.log)
            self.assertIn("trjalo/* matches no run", done.stderr)
        done = self.batch(kitti, *nothing, "--only", "*/03")
        self.assertEqual(done.returncode, 2, done.log)
        self.assertIn("No data", done.stderr)

    def test_two_batches_cannot_work_in_one_folder(self):
        begun = self.runs_that_never_end()
        process = self.start(SUITE)
        while not begun.exists() and process.poll() is None:
            time.sleep(0.02)
        done = self.batch(SUITE)
        self.assertEqual(done.returncode, 1)
        self.assertIn("another batch is at work", done.stderr)

    def test_an_interrupted_batch_ends_at_once_and_says_how_to_go_on(self):
        begun = self.runs_that_never_end()
        process = self.start(SUITE, stderr=subprocess.PIPE)
        while not begun.exists() and process.poll() is None:
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate()
        self.assertEqual(process.returncode, 130)
        self.assertIn("goes on where this one stopped", errors)
        self.assertEqual(self.statuses(), {})


if __name__ == "__main__":
    unittest.main()
