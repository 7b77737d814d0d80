# SPDX-License-Identifier: MIT
"""A plan knows what is done, what has changed, and never overwrites a result."""
import csv
import io
import json
import os
import subprocess
import unittest

from planned import SUITE, PlannedTest
from support import SCRIPTS, not_described

from trajlo_batch import plan
from trajlo_batch.suite import read_suite
from trajlo_batch.yaml_lines import SuiteError


class OnlyTest(PlannedTest):
    """What scripts/batch says about some of the runs of a suite."""

    def setUp(self):
        super().setUp()
        batch = self.plan()
        self.finish(batch)
        for run, code, reason in zip(batch.runs, (0, -9), ("ok", "timeout")):
            folder = self.places.output / run.folder
            (folder / "status.json").write_text(json.dumps(
                {"depends_on": run.job["depends_on"], "exit_code": code, "reason": reason,
                 "wall_s": 1.0}))
            (folder / "evaluation_status.json").write_text(json.dumps(
                {"exit_code": 0, "reason": "no truth"}))

    def batch(self, *arguments):
        return subprocess.run(
            [SCRIPTS / "batch", self.folder / "s.yaml", "--build", self.places.build, "--output",
             self.places.output, *arguments], capture_output=True, text=True, check=False)

    def test_a_run_that_only_leaves_out_does_not_decide_how_the_batch_ends(self):
        done = self.batch("--only", "plain/*", "--report")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertNotIn("timeout", done.stdout)
        self.assertIn("1 without truth, 1 with an x", done.stdout)
        done = self.batch("--only", "varied/*", "--report")
        self.assertEqual(done.returncode, 3)
        self.assertIn("  x varied/hall_os1_16-seed1: timeout\n", done.stdout)

    def test_a_misspelt_run_is_told_the_right_one(self):
        for option in ("--only", "--command"):
            done = self.batch(option, "plain/hall_os1_16-seed")
            self.assertEqual(done.returncode, 1)
            self.assertIn("; did you mean plain/hall_os1_16-seed1?\n", done.stderr)

    def test_every_column_of_its_results_is_described(self):
        self.batch("--report")
        head, *_ = (self.places.output / "results.csv").read_text().splitlines()
        self.assertIn("peak_memory_mb", head)
        self.assertEqual(not_described([*head.split(","), "rpe_1m_rotation_rmse_deg"],
                                       "config/suites/README.md"), [])

    def test_the_page_says_the_whole_rule_of_an_x(self):
        self.batch("--report")
        self.assertIn("above both 10 % of the path and 0.5 m",
                      (self.places.output / "report.html").read_text())

    def test_the_list_says_which_runs_failed(self):
        self.assertEqual(self.batch("--list").stdout,
                         "   1 done     plain/hall_os1_16-seed1\n"
                         "   2 x        varied/hall_os1_16-seed1 (timeout)\n")


class OutdatedTest(PlannedTest):
    """What scripts/batch says about results whose options have changed since."""

    def setUp(self):
        super().setUp()
        # Shows what --set says, as the real one does.
        self.executable("build/apps/trajlo_run", """#!/bin/sh
segments=4
for argument in "$@"; do
  case "$argument" in --set=window.segments=*) segments="${argument##*=}" ;; esac
done
printf 'window: {segments: %s}\\nsensor: {T_body_lidar: []}\\n' $segments
""")
        batch = self.plan()
        self.finish(batch)
        for run, segments in zip(batch.runs, (4, 3)):
            folder = f"out/{run.folder}"
            self.write(f"{folder}/evaluation_status.json", '{"exit_code": 0, "reason": ""}')
            self.write(f"{folder}/evaluation/evaluation.json", json.dumps(
                {"estimates": [{"pairs": 2, "ate": {"translation_m": {"rmse": 0.25}}}]}))
            self.write(f"{folder}/result/config.yaml",
                       f"window: {{segments: {segments}}}\nsensor: {{T_body_lidar: [1, 2]}}\n")

    def report(self, text, *arguments):
        done = subprocess.run(
            [SCRIPTS / "batch", self.write("s.yaml", text), "--build", self.places.build, "--output",
             self.places.output, "--report", *arguments], capture_output=True, text=True, check=False)
        lines = list(csv.DictReader(io.StringIO((self.places.output / "results.csv").read_text())))
        return done, lines, (self.places.output / "table.md").read_text()

    def test_results_of_what_is_asked_for_have_no_mark(self):
        done, lines, table = self.report(SUITE)
        self.assertEqual((done.returncode, done.stdout.splitlines()[0]), (0, "2 runs: 2 ended well"))
        self.assertEqual([line["outdated"] for line in lines], ["", ""])
        self.assertNotIn("outdated", table)

    def test_those_of_other_options_are_marked_and_keep_their_own_options(self):
        done, lines, table = self.report(SUITE.replace("segments: 3", "segments: 7"))
        self.assertEqual(done.returncode, 3)
        self.assertIn("2 runs: 2 ended well (of which 1 outdated)\nOutdated: 1 of 2 runs; changed "
                      "since: options. Without --report and --only the same command", done.stdout)
        self.assertEqual([(line["outdated"], line["window.segments"]) for line in lines],
                         [("", "4"), ("options", "3")])
        self.assertNotIn("sensor.T_body_lidar", lines[0])
        self.assertIn("| **0.2500** | 0.2500 (outdated) |", table)
        self.assertIn("- outdated: what the run was made with has changed since", table)
        self.assertIn("outdated: options changed since",
                      (self.places.output / "report.html").read_text())

    def test_those_that_only_leaves_out_are_marked_and_do_not_decide_how_the_batch_ends(self):
        changed = SUITE.replace("segments: 3", "segments: 7")
        done, _, table = self.report(changed, "--only", "plain/*")
        self.assertEqual(done.returncode, 0)
        self.assertIn("Outdated: 1 of 2 runs", done.stdout)
        self.assertIn("0.2500 (outdated)", table)

    def test_an_option_that_changed_for_all_runs_has_a_column(self):
        _, lines, _ = self.report(SUITE.split("configurations")[0] + "configurations:\n  - name: plain\n"
                                  "    set: {window.segments: 9}\n")
        self.assertEqual([line["window.segments"] for line in lines], ["4"])

    def test_another_evaluation_and_another_build_are_changes_as_well(self):
        other = SUITE.replace("hall_os1_16", "hall_os1_16\n    evaluate: {alignment: origin}")
        done, lines, _ = self.report(other)
        self.assertEqual((done.returncode, lines[0]["outdated"]), (3, "evaluation"))
        for name in ("trajlo_run", "trajlo_evaluate"):
            path = self.places.build / "apps" / name
            path.write_text(path.read_text() + "# rebuilt\n")
        done, lines, _ = self.report(SUITE)
        self.assertEqual((done.returncode, lines[0]["outdated"]), (3, "program, evaluation"))
        self.assertIn("--any-version accepts other builds", done.stdout)
        self.assertEqual(self.report(SUITE, "--any-version")[0].returncode, 0)


class PlanTest(PlannedTest):
    def states(self, batch):
        return [run.state for run in batch.runs]

    def test_at_first_everything_is_missing_then_everything_is_done(self):
        batch = self.plan()
        self.assertEqual(self.states(batch), ["missing", "missing"])
        self.finish(batch)
        self.assertEqual(self.states(self.plan()), ["done", "done"])

    def test_only_the_run_whose_options_changed_is_done_again(self):
        self.finish(self.plan())
        batch = self.plan(SUITE.replace("segments: 3", "segments: 5"))
        self.assertEqual([(run.state, run.changes) for run in batch.runs],
                         [("done", ()), ("changed", ("options",))])

    def test_a_rebuilt_program_changes_all_runs_unless_any_version_will_do(self):
        self.finish(self.plan())
        self.pretend_build("second")
        self.assertEqual([run.changes for run in self.plan().runs], [("program",), ("program",)])
        self.assertEqual(self.states(self.plan(any_version=True)), ["done", "done"])

    def test_another_seed_is_another_recording(self):
        batch = self.plan()
        self.finish(batch)
        other = self.plan(SUITE.replace("hall_os1_16", "hall_os1_16\n    duration_s: 5"))
        self.assertEqual([run.changes for run in other.runs], [("recording",), ("recording",)])

    def test_a_recording_that_has_changed_is_run_again_and_no_other(self):
        for name in ("a.bag", "b/scans/1.pcd", "b/scans/2.pcd", "c.bag"):
            self.write(f"data/{name}", "scan")
        suite = ("sequences:\n  - {name: a, recording: a.bag}\n  - {name: b, recording: b}\n"
                 "  - {name: c, recording: c.bag}\nconfigurations:\n  - name: plain\n")
        newer_ns = 1_000_000_000 + (self.folder / "data" / "a.bag").stat().st_mtime_ns

        def touch(name):
            os.utime(self.folder / "data" / name, ns=(newer_ns, newer_ns))

        def replace(name):  # by one that is as old
            stat = (self.folder / "data" / name).stat()
            self.write(f"data/{name}", "another")
            os.utime(self.folder / "data" / name, ns=(stat.st_atime_ns, stat.st_mtime_ns))

        def add():
            stat = (self.folder / "data" / "b" / "scans" / "2.pcd").stat()
            path = self.write("data/b/scans/3.pcd", "")
            os.utime(path, ns=(stat.st_atime_ns, stat.st_mtime_ns))

        self.finish(self.plan(suite))
        for change, changed in ((lambda: None, []), (lambda: touch("a.bag"), ["plain/a"]),
                                (lambda: replace("a.bag"), ["plain/a"]),
                                (lambda: touch("b/scans/1.pcd"), ["plain/b"]), (add, ["plain/b"]),
                                (lambda: (self.folder / "data/b/scans/3.pcd").unlink(),
                                 ["plain/b"])):
            change()
            batch = self.plan(suite)
            self.assertEqual([run.folder for run in batch.runs if run.changes == ("recording",)],
                             changed)
            self.assertEqual(self.states(batch).count("done"), 3 - len(changed))
            self.finish(batch)

    def test_a_changed_result_is_moved_and_not_overwritten(self):
        self.finish(self.plan())
        kept = self.places.output / "varied" / "hall_os1_16-seed1" / "result.txt"
        kept.write_text("worth keeping")
        batch = self.plan(SUITE.replace("segments: 3", "segments: 5"))
        plan.write_plan(batch, keep_recordings=True)
        moved = self.places.output / "replaced" / "varied" / "hall_os1_16-seed1.1" / "result.txt"
        self.assertEqual(moved.read_text(), "worth keeping")
        self.assertFalse(kept.exists())

    def test_a_second_change_does_not_take_the_place_of_the_first(self):
        for segments in (3, 5, 6):
            self.finish(self.plan(SUITE.replace("segments: 3", f"segments: {segments}")))
        names = sorted(path.name for path in
                       (self.places.output / "replaced" / "varied").iterdir())
        self.assertEqual(names, ["hall_os1_16-seed1.1", "hall_os1_16-seed1.2"])

    def test_planning_again_touches_no_file(self):
        self.finish(self.plan())

        def times():
            return {str(path): path.stat().st_mtime_ns for path in
                    self.places.output.rglob("*job.json")}

        before = times()
        self.finish(self.plan())
        self.assertEqual(times(), before)
        self.assertEqual(len(before), 4)

    def test_failed_runs_are_tried_again_on_request_only(self):
        self.finish(self.plan(), exit_code=4)
        self.assertEqual(self.states(self.plan()), ["done", "done"])
        self.assertEqual(self.states(self.plan(retry=True)), ["changed", "changed"])

    def test_an_evaluation_that_failed_is_tried_again_on_request_too(self):
        batch = self.plan()
        self.finish(batch)
        status = self.places.output / batch.runs[0].folder / "evaluation_status.json"
        status.write_text(json.dumps({"exit_code": 6, "reason": "no evaluation: a defect"}))
        self.assertEqual([run.state for run in self.plan().runs], [plan.DONE, plan.DONE])
        self.assertEqual([run.state for run in self.plan(retry=True).runs],
                         [plan.CHANGED, plan.DONE])
        status.write_text(json.dumps({"exit_code": None, "reason": "no truth"}))
        self.assertEqual([run.state for run in self.plan(retry=True).runs], [plan.DONE, plan.DONE])

    def test_files_that_options_and_flags_name_are_a_part_of_what_a_run_is(self):
        times = self.write("times.txt", "1\n")
        text = SUITE.replace("simulate: hall_os1_16", "simulate: hall_os1_16\n"
                             "    run: {config: mine.yaml}\n    evaluate: {times: times.txt}")
        mine = self.write("mine.yaml", "")
        self.finish(self.plan(text))
        for run in self.plan(text).runs:  # as if they had been evaluated
            (self.places.output / run.folder / "evaluation_status.json").write_text("{}")
        self.assertEqual({run.outdated for run in self.plan(text).runs}, {()})
        times.write_text("2\n")
        self.assertEqual({run.outdated for run in self.plan(text).runs}, {("evaluation",)})
        mine.write_text("window: {segments: 2}\n")
        self.assertEqual({run.outdated for run in self.plan(text).runs},
                         {("options", "evaluation")})

    def test_a_folder_is_that_of_one_suite(self):
        self.finish(self.plan())
        other = self.write("other/s.yaml", SUITE)
        with self.assertRaisesRegex(SuiteError, f"holds the runs of {self.folder}/s.yaml, "
                                    f"and not of {other}; name"):
            plan.make_plan(read_suite(other), self.places)
        (self.folder / "s.yaml").unlink()  # It was moved.
        plan.make_plan(read_suite(other), self.places)

    def test_results_do_not_go_into_a_recording(self):
        recording = self.places.output.parent
        text = (f"sequences:\n  - {{name: a, recording: {recording}}}\n"
                "configurations:\n  - name: plain\n")
        with self.assertRaisesRegex(SuiteError, "lies in the recording"):
            self.plan(text)

    def test_an_option_that_does_not_exist_ends_the_batch_before_it_begins(self):
        with self.assertRaisesRegex(SuiteError, "varied.*no such option"):
            self.plan(SUITE.replace("window.segments", "bad"))

    def test_missing_data_are_named(self):
        batch = self.plan("sequences:\n  - {name: one, recording: a.bag, truth: a.tum}\n"
                          "configurations:\n  - name: plain\n")
        self.assertEqual(batch.runs, [])
        self.assertEqual(batch.missing, {"one": [str(self.folder / "data" / "a.bag"),
                                                 str(self.folder / "data" / "a.tum")]})

    def test_a_program_that_is_not_built_is_named(self):
        (self.places.build / "apps" / "trajlo_evaluate").unlink()
        with self.assertRaisesRegex(SuiteError, "trajlo_evaluate is missing; build it"):
            self.plan()


if __name__ == "__main__":
    unittest.main()
