# SPDX-License-Identifier: MIT
"""Figures are drawn of everything that an evaluation may hold, and pages hold all they show."""
import json
import re
import subprocess
import unittest
import unittest.mock

import numpy as np
from evaluation_folder import write_evaluation
from result_folder import BEGIN_S, on_walls, write_ply, write_result
from support import ROOT, SCRIPTS, FolderTest

from trajlo_report import (evaluated, evaluation_words, figures_errors, figures_evaluation, files,
                           names, page, run_summary, theme, view)


class EvaluationPageTest(FolderTest):
    def draw(self, *arguments):
        done = subprocess.run([SCRIPTS / "draw_evaluation.py", self.folder, *arguments],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return self.folder / "report.html"

    def test_all_figures_are_there_in_all_formats_and_the_page_holds_them(self):
        write_evaluation(self.folder, {"one": 0.01, "two": 0.2})
        report = self.draw()
        names = {path.name for path in (self.folder / "figures").iterdir()}
        drawn = set(figures_evaluation.FIGURES) - {"kitti_lengths"}  # the path is too short
        self.assertEqual(names, {f"{name}.{kind}" for name in drawn for kind in theme.FORMATS})
        self.assert_self_contained(report)
        self.assertEqual(report.read_text().count("data:image/svg+xml"), len(names) / 3)

    def test_a_new_run_removes_the_figures_of_the_earlier_one(self):
        code = (ROOT / "core/report/drawn_files.cc").read_text()
        listed, = re.findall(r"kFigures\[\] = \{(.*?)\};", code, re.DOTALL)
        drawn = {"thumbnail", "map", "windows", *figures_evaluation.FIGURES}
        self.assertEqual(set(re.findall(r'"(\w+)"', listed)), drawn)

    def test_the_conclusion_is_a_sentence_for_each_the_best_first(self):
        write_evaluation(self.folder, {"worse": 0.1, "better": 0.01, "lost": 0.1},
                         diverged=("lost",))
        _, estimates = files.read_evaluation(self.folder)
        estimates[0].metrics["ate"]["translation_m"].update(rmse=0.25, max=1.5)
        said = evaluation_words.conclusions(estimates)
        estimates[1].metrics["completeness"] = 0.5 * estimates[0].metrics["completeness"]
        self.assertIn("cover different shares of the truth", evaluation_words.conclusions(estimates)[-1])
        self.assertRegex(said[0], r"better is .* cm from the truth .* over a path of \d+")
        self.assertIn("worse is 25.0 cm from the truth (root mean square after alignment; at most "
                      "1.5 m)", said[1])
        self.assertEqual(said[2], "lost diverged.")

    def test_a_diverged_estimate_is_said_to_be_one_and_does_not_shrink_the_others(self):
        write_evaluation(self.folder, {"good": 0.01, "lost": 0.1}, diverged=("lost",))
        self.assertIn("lost diverged: the error grew past 100 m", self.draw().read_text())
        _, estimates = files.read_evaluation(self.folder)
        low, high = evaluated.bounds(estimates)
        self.assertLess(max(high - low), 60)

    def test_kittis_errors_by_length_are_drawn_where_there_are_some(self):
        write_evaluation(self.folder, {"one": 0.01})
        _, estimates = files.read_evaluation(self.folder)
        self.assertIsNone(figures_errors.draw_kitti_lengths(estimates))
        estimates[0].metrics["kitti"] = {"per_length": [
            {"length_m": 100.0, "segments": 5, "translation_percent": 0.5,
             "rotation_deg_per_m": 0.001},
            {"length_m": 200.0, "segments": 0, "translation_percent": None,
             "rotation_deg_per_m": None}]}
        figure = figures_errors.draw_kitti_lengths(estimates)
        self.assertEqual(list(figure.axes[0].lines[0].get_xdata()), [100.0])

    def test_a_truth_without_rotation_leaves_that_panel_out(self):
        write_evaluation(self.folder, {"one": 0.01}, with_rotation=False)
        _, estimates = files.read_evaluation(self.folder)
        self.assertFalse(evaluated.has_rotation(estimates[0]))
        figure = figures_errors.draw_over_time(estimates)
        self.assertEqual(len(figure.axes), 4)

    def relative_errors(self):
        """The cells of the table, and what stands below it."""
        text = self.draw().read_text()
        text = text[text.index("<h3>Relative error"):text.index("<h2>Figures")]
        return re.findall(r"<td>(.*?)</td>", text), "distance between two poses" in text

    def test_relative_errors_are_those_of_distances_where_the_truth_has_only_positions(self):
        document = write_evaluation(self.folder, {"one": 0.01}, with_rotation=False)
        relative = files.read_json(document / "evaluation.json")["estimates"][0]["rpe"][0]
        shown = [page.number(relative["point_distance_m"][name], 4)
                 for name in ("rmse", "mean", "max")]
        self.assertEqual(self.relative_errors(), (["1.0 m *", "60", *shown, "–", "–", "–"], True))
        write_evaluation(self.folder, {"one": 0.01})
        cells, has_note = self.relative_errors()
        self.assertEqual((cells[0], has_note), ("1.0 m", False))
        self.assertNotIn("–", cells)

    def test_an_estimate_without_pairs_is_named_and_not_drawn(self):
        write_evaluation(self.folder, {"one": 0.01, "none": 0.01})
        (self.folder / "errors_none.csv").unlink()
        self.assertIn("none has no pairs with the truth", self.draw().read_text())

    def test_figures_as_wide_as_a_page_have_text_that_can_be_edited(self):
        write_evaluation(self.folder, {"one": 0.01})
        self.assert_self_contained(self.draw("--width", "page"))
        svg = (self.folder / "figures" / "over_time.svg").read_text()
        self.assertRegex(svg, r"<text[^>]*>time \[s\]</text>")
        pdf = (self.folder / "figures" / "over_time.pdf").read_bytes()
        self.assertIn(b"/FontFile2", pdf)  # TrueType, not outlines
        self.draw("--width", "page")
        self.assertEqual((self.folder / "figures" / "over_time.pdf").read_bytes(), pdf)

    def test_a_rotation_that_the_alignment_leaves_open_is_not_shown_as_an_error(self):
        write_evaluation(self.folder, {"one": 0.01})
        path = self.folder / "evaluation.json"
        document = json.loads(path.read_text())
        document["estimates"][0]["ate"]["rotation_determined"] = False
        document["estimates"][0]["ate"]["rotation_deg"]["rmse"] = 175.466
        path.write_text(json.dumps(document))
        text = self.draw().read_text()
        self.assertNotIn("175.47", text)
        self.assertIn("left open by the alignment", text)
        _, estimates = files.read_evaluation(self.folder)
        self.assertFalse(evaluated.has_rotation(estimates[0]))

    def test_a_folder_that_is_no_evaluation_is_named(self):
        done = subprocess.run([SCRIPTS / "draw_evaluation.py", self.folder], capture_output=True,
                              text=True, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("evaluation.json is missing", done.stderr)

    def test_names_are_text_and_never_markup(self):
        write_evaluation(self.folder, {"one": 0.01})
        path = self.folder / "evaluation.json"
        document = json.loads(path.read_text())
        document["estimates"][0]["name"] = "<b>bold</b>"
        path.write_text(json.dumps(document))
        self.assertNotIn("<b>", self.draw().read_text())


class RunPageTest(FolderTest):
    def draw(self, *arguments):
        done = subprocess.run([SCRIPTS / "draw_run.py", self.folder, *arguments],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return (self.folder / "run.html").read_text()

    def test_the_page_begins_with_what_people_ask_for(self):
        write_result(self.folder)
        text = self.draw()
        self.assert_self_contained(self.folder / "run.html")
        top = text[text.index("<h1>"):text.index("<h2>")]
        for said in ("Office, OS0-64", "The run ended well.", "10.0 s", "19 of 20 scans",
                     "12.3 m", "0.30 s", "<dt>3</dt>",
                     "flagged: gap 1 (0.10 s), not converged 2 (0.06 s)", "Warning: a scan is missing"):
            self.assertIn(said, top)
        self.assertNotIn("resources.cpu_s", top)
        self.assertIn("resources.cpu_s", text)  # below

    def test_numbers_agree_with_the_evaluation(self):
        write_result(self.folder, seconds=40)
        write_evaluation(self.folder / "evaluation", {"one": 0.2}, of=self.folder)
        _, estimates = files.read_evaluation(self.folder / "evaluation")
        rmse = estimates[0].metrics["ate"]["translation_m"]["rmse"]
        self.assertIn(f"<dt>{100 * rmse:.1f} cm</dt>",
                      self.draw("--evaluation", self.folder / "evaluation"))

    def test_the_evaluation_of_another_run_is_refused(self):
        write_result(self.folder / "other", seconds=20)
        evaluation = write_evaluation(self.folder / "evaluation", {"one": 0.2},
                                      of=self.folder / "other")
        own = write_result(self.folder / "own")
        before = sorted(own.iterdir())
        done = subprocess.run([SCRIPTS / "draw_run.py", own, "--evaluation", evaluation],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn(f"{evaluation} is the evaluation of another trajectory than that in {own}",
                      done.stderr)
        self.assertEqual(sorted(own.iterdir()), before)

    def test_points_can_be_fewer_and_not_none(self):
        write_result(self.folder)
        self.assertIn('"count": 77, ', self.draw("--points", "77"))
        done = subprocess.run([SCRIPTS / "draw_run.py", self.folder, "--points", "0"],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertIn("--points: must be at least 1", done.stderr)

    def test_without_its_library_the_page_says_what_to_install(self):
        with unittest.mock.patch.object(view, "THREE", self.folder / "nothing"):
            self.assertIn("libjs-three", view.missing_library())

    def test_a_folder_that_is_no_result_is_refused_and_left_alone(self):
        done = subprocess.run([SCRIPTS / "draw_run.py", self.folder], capture_output=True,
                              text=True, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("holds no result", done.stderr)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_a_run_that_left_nothing_still_has_a_page(self):
        self.write("run.json", "{}")
        self.draw()
        self.assertIn("There is no trajectory", (self.folder / "run.html").read_text())
        self.assert_self_contained(self.folder / "run.html")

    def test_a_trajectory_that_was_cut_off_is_drawn_as_far_as_it_goes(self):
        lines = [f"{0.1 * i} {i} 0 0 0 0 0 1" for i in range(30)]
        self.write("trajectory.tum", "\n".join(lines) + "\n3.0 30 0")
        self.assertIn("There is no map", self.draw())
        self.assertTrue((self.folder / "figures" / "windows.png").is_file())

    def test_an_estimate_that_exploded_does_not_take_the_page_along(self):
        result = write_result(self.folder)
        poses = (result / "trajectory.tum").read_text().splitlines()
        poses += ["1700000011 1e300 2 3 0 0 0 1", "1700000012 nan 2 3 0 0 0 1",
                  "1700000013 1 2 3 0 0 0 0"]
        (result / "trajectory.tum").write_text("\n".join(poses) + "\n")
        points = on_walls(np.random.default_rng(1), 500)
        points[::7] = np.inf
        write_ply(result / "view.ply", {
            **dict(zip("xyz", points.T)), "intensity": np.zeros(500), "t_s": np.zeros(500)},
            f"comment begin_s {BEGIN_S:.9f}")
        self.assertIn("Not drawn: 3 poses more than 1000 km from the start", self.draw())

    def test_what_made_a_run_fail_stands_on_top(self):
        lost = {"exit": {"code": 4, "reason": "lost", "message": "lost at 1700000003.5 s"},
                "result": {"begin_s": "1700000000.250", "lost_at_s": "1700000003.500"}}
        self.assertEqual(run_summary.verdict(lost), "The estimator got lost 3.2 s after the start: "
                         "do not trust poses from there on.")
        for exit_, said in (({"code": 6, "reason": "failed", "message": "no memory"},
                             "The run failed. No memory."),
                            ({"code": None, "reason": "running", "message": ""}, "did not finish"),
                            ({"code": 2, "reason": "input_unreadable", "message": "no file"},
                             "The run failed: input_unreadable. No file.")):
            self.assertIn(said, run_summary.verdict({"exit": exit_}))


class PageTest(unittest.TestCase):
    def test_lengths_of_millimetres_keep_a_digit(self):
        self.assertEqual([run_summary.length(metres) for metres in (0.0017, 0.0019, 0.0123, 1.5)],
                         ["1.7 mm", "1.9 mm", "1.2 cm", "1.5 m"])

    def test_numbers_are_short_and_small_ones_keep_their_digits(self):
        shown = [page.number(value) for value in (0.1234, 0.00012, 12, None, float("nan"), True)]
        self.assertEqual(shown, ["0.123", "0.00012", "12", "–", "–", "True"])

    def test_scenarios_have_titles_and_the_names_of_datasets_stay(self):
        for name, title in (("hall_os1_16x2-seed3", "Hall, 2 × OS1-16, seed 3"),
                            ("car_park_os1_128", "Car park, OS1-128"), ("eee_01", "eee_01"),
                            ("spin_avia", "Spin, Livox Avia"), ("00", "00"),
                            ("a_b-seed2", "a_b-seed2")):
            self.assertEqual(names.title(name), title)

    def test_no_line_is_drawn_over_a_gap(self):
        times, values = evaluated.with_gaps([0, 0.1, 0.2, 5.0, 5.1], [1, 2, 3, 4, 5])
        self.assertEqual(len(values), 6)
        self.assertNotEqual(values[3], values[3])


if __name__ == "__main__":
    unittest.main()
