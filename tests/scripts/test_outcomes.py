# SPDX-License-Identifier: MIT
"""What came out of the runs of a batch, in its table, on its page and while it goes on."""
import dataclasses
import io
import json
import pathlib
import subprocess
import tempfile
import unittest

from planned import PlannedTest
from support import SCRIPTS, FolderTest

from trajlo_batch import plan, results
from trajlo_batch.progress import ProgressBar, ProgressLines
from trajlo_report import files


class ResultsTest(PlannedTest):
    def test_a_run_that_was_not_started_is_told_from_one_that_did_not_end(self):
        batch = self.plan()
        self.assertEqual(results.collect(batch)[0]["reason"], "not started")
        plan.write_plan(batch, keep_recordings=True)
        self.write(f"out/{batch.runs[1].folder}/log.txt", "")
        self.assertEqual([row["reason"] for row in results.collect(batch)],
                         ["not started; see snakemake.log", "see log.txt and snakemake.log"])

    def test_a_crash_is_an_x_with_its_reason(self):
        batch = self.plan()
        self.finish(batch, exit_code=-11)
        row = results.collect(batch)[0]
        self.assertEqual((row["result"], row["exit_code"]), ("x", -11))

    def test_an_evaluated_run_has_its_metrics_and_a_diverged_one_an_x(self):
        batch = self.plan()
        self.finish(batch)
        for run, diverged in zip(batch.runs, (False, True)):
            folder = self.places.output / run.folder
            (folder / "evaluation").mkdir()
            (folder / "evaluation_status.json").write_text('{"exit_code": 0, "reason": ""}')
            (folder / "evaluation" / "evaluation.json").write_text(json.dumps({"estimates": [{
                "diverged": diverged, "divergence_reason": "too far" if diverged else "",
                "ate": {"translation_m": {"rmse": 0.25}}}]}))
        good, bad = results.collect(batch)
        self.assertEqual((good["result"], good["ate_rmse_m"]), ("ok", 0.25))
        self.assertEqual((bad["result"], bad["reason"]), ("x", "too far"))

    def test_doubts_about_the_comparison_reach_table_page_and_console(self):
        batch = self.plan()
        self.finish(batch)
        for run, warning in zip(batch.runs, ("positions are 0.24 times as large", "ATE [deg] says little")):
            folder = f"out/{run.folder}"
            self.write(f"{folder}/evaluation_status.json", '{"exit_code": 0, "reason": ""}')
            self.write(f"{folder}/evaluation/evaluation.json", json.dumps(
                {"estimates": [{"pairs": 2, "ate": {"translation_m": {"rmse": 0.25}}}],
                 "warnings": [f"/some where/else/trajectory.tum: {warning}"]}))
        done = subprocess.run(
            [SCRIPTS / "batch", self.folder / "s.yaml", "--build", self.places.build, "--output",
             self.places.output, "--report"], capture_output=True, text=True, check=False)
        said = "trajectory.tum: positions are 0.24 times as large"
        self.assertIn("2 ended well (of which 1 with warnings about the comparison with the truth)\n"
                      f"  ? plain/hall_os1_16-seed1: {said}\n", done.stdout)
        self.assertEqual([row["evaluation_warnings"] for row in results.collect(batch)], [said, ""])
        table = (self.places.output / "table.md").read_text()
        self.assertIn("| **0.2500 ?** | **0.2500** |", table)
        self.assertIn("- ?: trajlo_evaluate warns about the comparison", table)
        self.assertNotIn("?", (self.places.output / "speed.md").read_text())
        self.assertIn(f'<p class="failed">{said}</p>',
                      (self.places.output / "report.html").read_text())

    def test_a_killed_run_has_no_sums(self):
        batch = self.plan()
        self.finish(batch, exit_code=-9)
        folder = self.places.output / batch.runs[0].folder / "result"
        folder.mkdir()
        (folder / "run.json").write_text(json.dumps({
            "exit": {"code": None, "reason": "running"}, "versions": {"git": "abc"},
            "windows": {"inlier_share": 0.0}, "result": {"duration_s": 0.0, "poses_flagged": 0}}))
        row = results.collect(batch)[0]
        self.assertEqual([row[key] for key in ("data_s", "inlier_share", "poses_flagged",
                                               "times_real_time", "version")],
                         [None, None, None, None, "abc"])

    def test_rows_name_the_options_that_vary(self):
        batch = self.plan()
        batch.runs[1] = dataclasses.replace(batch.runs[1], options="window: {segments: 3}")
        self.assertEqual([row["window.segments"] for row in results.collect(batch)], [4, 3])

    def test_csv_has_a_line_a_run(self):
        lines = files.to_csv(results.collect(self.plan())).splitlines()
        self.assertEqual(len(lines), 3)
        self.assertTrue(lines[0].startswith("suite,configuration,sequence,group,seed,degenerate,"))


class MetricsTest(FolderTest):
    def test_a_rotation_that_the_alignment_leaves_open_is_no_error(self):
        ate = {"translation_m": {"rmse": 0.1}, "rotation_deg": {"rmse": 175.0}}
        for said, rotation in ((False, None), (True, 175.0), (None, 175.0)):
            own = ate if said is None else {**ate, "rotation_determined": said}
            self.write("evaluation/evaluation.json", json.dumps({"estimates": [{"ate": own}]}))
            values, _ = results.evaluation_values(self.folder)
            self.assertEqual((values["ate_rmse_m"], values["ate_rotation_rmse_deg"]),
                             (0.1, rotation))


class ProgressTest(unittest.TestCase):
    def test_the_bar_says_what_is_done_and_when_the_rest_will_be(self):
        bar = ProgressBar(10, {"a/b": {}, "a/c": {}}, io.StringIO())
        line = bar.line(done=6, failed=1, complete=2, elapsed=60, width=80)
        self.assertIn("6/10 runs, 1 x, 1:00, 1:00 left", line)
        self.assertLessEqual(len(line), 80)

    def test_in_a_pipe_each_run_that_ends_has_a_line(self):
        stream = io.StringIO()
        ended = {"a/b": results.Ended("ok", "ok", 1)}
        lines = ProgressLines(3, ended, stream)
        lines.update(ended, 0)
        self.assertEqual(stream.getvalue(), "")
        ended["a/c"] = results.Ended("x", "estimator lost", 75.2)
        lines.update(ended, 1)
        lines.update(ended, 2)
        ended["a/d"] = results.Ended("ok", "ok", 3.14)
        lines.update(ended, 2)
        self.assertEqual(stream.getvalue(), "2/3 a/c: x, estimator lost, 1:15\n3/3 a/d: ok, 3.1 s\n")

    def test_a_run_that_is_not_evaluated_yet_has_no_verdict_and_a_diverged_one_has_an_x(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            self.assertIsNone(results.ended(folder))
            files.write_atomically(folder / "status.json", json.dumps(
                {"exit_code": 0, "reason": "ok", "wall_s": 1.0}))
            self.assertIsNone(results.ended(folder))
            files.write_atomically(folder / "evaluation_status.json", json.dumps({"reason": ""}))
            files.write_atomically(folder / "evaluation" / "evaluation.json", json.dumps(
                {"estimates": [{"diverged": True, "divergence_reason": "too far"}]}))
            self.assertEqual(results.ended(folder), results.Ended("x", "too far", 1.0))

    def test_a_run_that_is_too_short_for_its_truth_is_told_how_to_be_judged_anyway(self):
        said = "the estimate covers 33.5 % of the ground truth, less than 50 %"
        short = {"diverged": True, "divergence_reason": said}
        for estimate in (short, {**short, "incomplete": True}):
            self.assertRegex(results.divergence(estimate), r"50 %;.* evaluate: {min_completeness: 0}")
        self.assertEqual(results.divergence({**short, "incomplete": False}), said)
        self.assertEqual(results.divergence({}), "")

    def test_when_all_runs_have_ended_the_bar_counts_those_that_are_complete(self):
        bar = ProgressBar(10, {}, io.StringIO())
        line = bar.line(done=10, failed=0, complete=6, elapsed=60, width=80)
        self.assertIn("10/10 runs, 0 x, 1:00, 6 of them complete", line)


if __name__ == "__main__":
    unittest.main()
