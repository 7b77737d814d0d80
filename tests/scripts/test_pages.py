# SPDX-License-Identifier: MIT
"""Figures are drawn of everything that an evaluation may hold, and pages hold all they show."""
import json
import subprocess
import unittest

from evaluation_folder import write_evaluation
from support import SCRIPTS, FolderTest

from trajlo_report import evaluated, figures_errors, figures_evaluation, files, page
from trajlo_report import theme as themes


class EvaluationPageTest(FolderTest):
    def draw(self, *arguments):
        done = subprocess.run([SCRIPTS / "draw_evaluation.py", self.folder, *arguments],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return self.folder / "report.html"

    def test_all_figures_are_there_as_svg_and_png_and_the_page_holds_them(self):
        write_evaluation(self.folder, {"one": 0.01, "two": 0.2})
        report = self.draw()
        names = {path.name for path in (self.folder / "figures").iterdir()}
        drawn = set(figures_evaluation.FIGURES) - {"kitti_lengths"}  # the path is too short
        self.assertEqual(names, {f"{name}.{kind}" for name in drawn for kind in ("svg", "png")})
        self.assert_self_contained(report)
        self.assertEqual(report.read_text().count("data:image/svg+xml"), len(names) / 2)

    def test_a_diverged_estimate_is_said_to_be_one_and_does_not_shrink_the_others(self):
        write_evaluation(self.folder, {"good": 0.01, "lost": 0.1}, diverged=("lost",))
        self.assertIn("lost diverged: the error grew past 100 m", self.draw().read_text())
        _, estimates = files.read_evaluation(self.folder)
        low, high = evaluated.bounds(estimates)
        self.assertLess(max(high - low), 60)

    def test_kittis_errors_by_length_are_drawn_where_there_are_some(self):
        write_evaluation(self.folder, {"one": 0.01})
        _, estimates = files.read_evaluation(self.folder)
        self.assertIsNone(figures_errors.draw_kitti_lengths(estimates, themes.LIGHT))
        estimates[0].metrics["kitti"] = {"per_length": [
            {"length_m": 100.0, "segments": 5, "translation_percent": 0.5,
             "rotation_deg_per_m": 0.001},
            {"length_m": 200.0, "segments": 0, "translation_percent": None,
             "rotation_deg_per_m": None}]}
        figure = figures_errors.draw_kitti_lengths(estimates, themes.LIGHT)
        self.assertEqual(list(figure.axes[0].lines[0].get_xdata()), [100.0])

    def test_a_truth_without_rotation_leaves_that_panel_out(self):
        write_evaluation(self.folder, {"one": 0.01}, with_rotation=False)
        _, estimates = files.read_evaluation(self.folder)
        self.assertFalse(evaluated.has_rotation(estimates[0]))
        figure = figures_errors.draw_over_time(estimates, themes.LIGHT)
        self.assertEqual(len(figure.axes), 4)

    def test_an_estimate_without_pairs_is_named_and_not_drawn(self):
        write_evaluation(self.folder, {"one": 0.01, "none": 0.01})
        (self.folder / "errors_none.csv").unlink()
        self.assertIn("none has no pairs with the truth", self.draw().read_text())

    def test_the_dark_theme_is_self_contained_as_well(self):
        write_evaluation(self.folder, {"one": 0.01})
        self.assert_self_contained(self.draw("--theme", "dark", "--width", "page"))

    def test_a_folder_that_is_no_evaluation_is_named(self):
        done = subprocess.run([SCRIPTS / "draw_evaluation.py", self.folder], capture_output=True,
                              text=True, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertIn("evaluation.json is missing", done.stderr)

    def test_names_are_text_and_never_markup(self):
        write_evaluation(self.folder, {"one": 0.01})
        path = self.folder / "evaluation.json"
        document = json.loads(path.read_text())
        document["estimates"][0]["name"] = "<b>bold</b>"
        path.write_text(json.dumps(document))
        self.assertNotIn("<b>", self.draw().read_text())


class RunPageTest(FolderTest):
    def test_a_run_that_left_nothing_still_has_a_page(self):
        done = subprocess.run([SCRIPTS / "draw_run.py", self.folder], capture_output=True,
                              text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("There is no trajectory", (self.folder / "run.html").read_text())
        self.assert_self_contained(self.folder / "run.html")

    def test_a_trajectory_that_was_cut_off_is_drawn_as_far_as_it_goes(self):
        lines = [f"{0.1 * i} {i} 0 0 0 0 0 1" for i in range(30)]
        self.write("trajectory.tum", "\n".join(lines) + "\n3.0 30 0")
        subprocess.run([SCRIPTS / "draw_run.py", self.folder, "--theme", "light"], check=True,
                       capture_output=True)
        self.assertTrue((self.folder / "figures" / "windows.png").is_file())
        self.assertIn("There is no map", (self.folder / "run.html").read_text())


class PageTest(unittest.TestCase):
    def test_numbers_are_short_and_small_ones_keep_their_digits(self):
        shown = [page.number(value) for value in (0.1234, 0.00012, 12, None, float("nan"), True)]
        self.assertEqual(shown, ["0.123", "0.00012", "12", "–", "–", "True"])

    def test_no_line_is_drawn_over_a_gap(self):
        times, values = evaluated.with_gaps([0, 0.1, 0.2, 5.0, 5.1], [1, 2, 3, 4, 5])
        self.assertEqual(len(values), 6)
        self.assertNotEqual(values[3], values[3])


if __name__ == "__main__":
    unittest.main()
