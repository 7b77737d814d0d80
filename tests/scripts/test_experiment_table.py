# SPDX-License-Identifier: MIT
"""results.csv of an experiment says what varied, what came of it, and how to repeat it."""
import csv
import io
import json
import shutil
import subprocess
import unittest

from pretended_experiment import SMALL, PretendedTest
from support import SCRIPTS, not_described

from trajlo_batch import plan
from trajlo_batch.yaml_lines import SuiteError
from trajlo_experiment import table
from trajlo_experiment.experiment import read_experiment
from trajlo_report import files


class TableTest(PretendedTest):
    def rows(self, text=SMALL, **finished):
        batch = self.batch(text)
        self.finish(batch, finished.pop("error_of", lambda *_: 0.1), **finished)
        return table.collect(self.batch(text))

    def test_a_row_has_what_varied_every_metric_and_the_versions(self):
        row = self.rows()[0]
        self.assertEqual((row["row"], row["window.segments"], row["expert.registration.kernel"], row["group"],
                          row["seed"], row["result"]), (1, 3, "none", "hall_os1_16", 1, "ok"))
        self.assertEqual((row["ate_rmse_m"], row["ate_rotation_rmse_deg"], row["rpe_1m_rmse_m"],
                          row["diverged"], row["exit_code"]), (0.1, 1.0, 0.1, False, 0))
        self.assertEqual((row["rounds_per_window"], row["iterations_per_window"],
                          row["rejected_steps"]), (3.0, 4.0, 3))
        self.assertAlmostEqual(row["smallest_eigenvalue_median"], 0.15)
        self.assertEqual((row["smallest_eigenvalue_min"], row["share_flagged"], row["share_gap"],
                          row["share_lost"]), (0.1, 0.5, 0.25, 0.0))
        self.assertIn("trajlo_run 0.1.0", row["program"])

    def test_time_for_a_second_of_data_is_of_all_data_and_not_only_of_what_the_truth_covers(self):
        row = self.rows()[0]
        self.assertEqual((row["cpu_s"], row["duration_s"], row["cpu_ms_per_data_second"]),
                         (1.0, 2.0, 250.0))

    def test_the_share_of_inliers_is_the_mean_over_the_windows(self):
        self.assertAlmostEqual(self.rows()[0]["inlier_share"], 0.7)

    def test_a_killed_run_has_what_its_windows_say_and_no_zeros_for_what_it_did_not_write(self):
        batch = self.batch(SMALL)
        self.finish(batch, lambda *_: 0.1)
        folder = self.places.output / batch.runs[0].folder
        status = json.loads((folder / "status.json").read_text())
        (folder / "status.json").write_text(json.dumps(
            {**status, "exit_code": -9, "reason": "longer than 1 s"}))
        (folder / "result" / "run.json").write_text(json.dumps(
            {"exit": {"code": None, "reason": "running"}, "windows": {"inlier_share": 0.0},
             "result": {"duration_s": 0.0, "poses_flagged": 0}}))
        row = table.collect(batch)[0]
        self.assertEqual((row["result"], row["poses_flagged"], row["cpu_ms_per_data_second"]),
                         ("x", None, None))
        self.assertAlmostEqual(row["inlier_share"], 0.7)

    def test_every_column_is_described(self):
        columns = [name for name in self.rows()[0] if "." not in name]  # those with dots are options
        self.assertEqual(not_described(columns, "config/experiments/README.md",
                                       "config/suites/README.md"), [])

    def test_a_metric_whose_least_value_is_not_the_best_is_refused(self):
        def check(metric):
            text = f"{SMALL}metric: {metric}\n"
            table.check_metric(read_experiment(self.write("e.yaml", text)))

        for metric in ("ate_rmse_m", "rpe_10m_rmse_m", "kitti_translation_percent", "share_lost",
                       "cpu_ms_per_data_second", "wall_s", "rounds_per_window"):
            check(metric)
        for metric in ("inlier_share", "times_real_time", "smallest_eigenvalue_min", "pairs",
                       "path_length_m", "points_per_window"):
            with self.assertRaisesRegex(SuiteError, f"the least {metric} is not the best"):
                check(metric)
        with self.assertRaisesRegex(SuiteError, "did you mean 'inlier_share'"):
            check("inlier_shar")

    def test_every_column_of_windows_and_flags_may_be_the_metric(self):
        row = self.rows()[0]
        for metric in table.METRICS:
            self.assertIsInstance(row[metric], (int, float), metric)
        columns = [name for name in row if name.startswith(("share_", "smallest_"))
                   or name.endswith("_per_window")]
        self.assertLessEqual(set(columns), set(table.METRICS))

    def test_a_factor_that_a_point_leaves_alone_has_the_value_of_the_run(self):
        row = self.rows()[-1]
        self.assertEqual((row["marks"], row["in_design"], row["window.segments"]),
                         ("defaults", 0, 4))

    def test_a_run_that_left_nothing_is_a_row_as_well(self):
        batch = self.batch(SMALL)
        self.finish(batch, lambda *_: None)
        shutil.rmtree(self.places.output / batch.runs[0].folder / "result")
        rows = table.collect(batch)
        self.assertEqual({row["result"] for row in rows}, {"x"})
        self.assertEqual({row["reason"] for row in rows}, {"too far"})
        self.assertIsNone(rows[0]["rejected_steps"])
        self.assertEqual(rows[0].keys(), rows[1].keys())

    def test_the_csv_file_has_a_line_a_run(self):
        lines = list(csv.DictReader(io.StringIO(files.to_csv(self.rows()))))
        self.assertEqual([line["row"] for line in lines], [str(i) for i in range(1, 11)])

    def test_the_command_of_a_row_runs_and_evaluates_in_a_folder_of_its_own(self):
        self.finish(self.batch(SMALL), lambda *_: 0.1)
        plan.write_json(self.places.output / "recordings/hall_os1_16-seed1/there.json", {})
        command = [SCRIPTS / "experiment", self.folder / "e.yaml", "--build", self.places.build,
                   "--output", self.places.output, "--command"]
        done = subprocess.run([*command, "1"], capture_output=True, text=True, check=True)
        run, evaluate = done.stdout.strip().split("; ")
        self.assertEqual(run, f"{self.places.build}/apps/trajlo_run --output=row-1 --threads=1")
        self.assertEqual(evaluate, "trajlo_evaluate row-1/trajectory.tum --truth=t.tum "
                                   "--output=row-1/evaluation")
        wrong = subprocess.run([*command, "11"], capture_output=True, text=True, check=False)
        self.assertEqual(wrong.returncode, 1)
        self.assertIn("count from 1 to 10", wrong.stderr)


if __name__ == "__main__":
    unittest.main()
