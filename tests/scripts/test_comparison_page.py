# SPDX-License-Identifier: MIT
"""The page of a comparison of solvers says what it found in plain words, and hides no variant."""
import json
import re
import subprocess
import unittest

import numpy as np

from support import SCRIPTS, FolderTest

from trajlo_report import comparison_words as words
from trajlo_report import window_times

BEGIN_S = 1.6e9
# name, set, ms a window, largest distance from the first's solution, from its trajectory, when
# they part (s after the begin), error
VARIANTS = (("plain", "solver.kind=gauss_newton", 2.0, 0.0, 0.0, None, 0.010),
            ("twin", "solver.kind=ceres", 1.0, 1e-12, 1e-15, None, 0.010),
            ("rough", "solver.kind=ceres,solver.x=1", 4.0, 3e-5, 2e-3, 1.25, 0.012),
            ("slow", "solver.kind=ceres,solver.x=2", 80.0, 1e-9, 1e-9, None, 0.010),
            ("kernel_huber", "weights.kernel=huber", 0.5, 4e-3, 5e-2, 0.3, 0.020))


def variant(name, settings, total_ms, apart_m, free_apart_m, parts_s, error_m):
    return {"name": name, "set": settings,
            "lockstep": {"windows": 6, "not_finite": 0, "steps_per_window": 3.0,
                         "rejected_steps": 0, "median_evaluate_ms": 0.7 * total_ms,
                         "median_linear_solve_ms": 0.2 * total_ms, "median_total_ms": total_ms,
                         "cost_after": 1.0, "median_from_first_m": apart_m / 2,
                         "max_from_first_m": apart_m, "max_from_first_rad": 0.0},
            "free": {"trajectory": f"free/{name}/trajectory.tum", "poses": 3, "poses_compared": 3,
                     "cpu_s": total_ms,
                     "wall_s": total_ms, "windows": 6, "rounds": 9, "rejected_steps": 0,
                     "stages_ms": {"solve": total_ms}, "lost_at_s": None,
                     "max_from_first_m": free_apart_m, "ate_rmse_m": error_m,
                     "parts_at_s": None if parts_s is None else f"{BEGIN_S + parts_s:.9f}"}}


class ComparisonPageTest(FolderTest):
    def setUp(self):
        super().setUp()
        self.document = {"input": ["a.bag"], "truth": "truth.tum", "versions": {"trajlo": "0.1.0"},
                         "variants": [variant(*item) for item in VARIANTS]}
        lockstep = ["variant,window,points,steps,rejected_steps,total_ms,from_first_m"]
        iterations = ["variant,window,iteration,cost"]
        for name, _, total_ms, apart_m, *_ in VARIANTS:
            for window in range(6):
                lockstep.append(f"{name},{window},{1000 + window},3,0,{total_ms},{apart_m / 2}")
                # The slow one has nothing to gain.
                costs = (5, 5, 5) if name == "slow" else (9, 6, 5)
                iterations += [f"{name},{window},{i},{cost}" for i, cost in enumerate(costs)]
            self.write(f"free/{name}/trajectory.tum",
                       f"{BEGIN_S:.9f} 0 0 0 0 0 0 1\n{BEGIN_S + 2:.9f} 1 0 0 0 0 0 1\n")
        self.write("lockstep.csv", "\n".join(lockstep) + "\n")
        self.write("iterations.csv", "\n".join(iterations) + "\n")
        self.write("config.yaml", "solver: {}\n")

    def draw(self):
        self.write("comparison.json", json.dumps(self.document))
        done = subprocess.run([SCRIPTS / "draw_comparison.py", self.folder], capture_output=True,
                              text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assert_self_contained(self.folder / "report.html")
        return (self.folder / "report.html").read_text()

    def row(self, text, name):
        """The cells of the last table's line of a variant."""
        line = re.findall(rf"<tr><td class=\"text\">{name}</td>.*?</tr>", text, re.DOTALL)[-1]
        return [re.sub(r"<.*?>", "", cell) for cell in re.findall(r"<td.*?</td>", line, re.DOTALL)]

    def test_the_conclusion_compares_what_minimises_the_same(self):
        text = self.draw()
        for said in ("twin solves a window fastest, in 1 ms (plain takes 2.0 × as long); slow is "
                     "slowest, 80 × as long.",
                     "2 of 3 find a solution that equals that of plain to within a micrometre; the "
                     "farthest, rough, differs by 30 µm.",
                     "2 of 4 end with a trajectory that equals that of plain to within a "
                     "micrometre; the farthest, kernel_huber, differs by 5.0 cm.",
                     "Position errors range from 1.0 cm (plain) to 2.0 cm (kernel_huber)."):
            self.assertIn(said, text)

    def said_of_windows(self, ms_of, windows=8, kernels=()):
        """What the page says of variants whose times (ms) are those."""
        lockstep = [variant(name, "kernel" if name in kernels else "", np.median(ms), 0, 0, None, 0)
                    for name, ms in ms_of.items()]
        columns = [(window, name, ms[window % len(ms)])
                   for name, ms in ms_of.items() for window in range(windows)]
        return words.of_windows(lockstep, dict(zip(("window", "variant", "total_ms"),
                                                   zip(*columns))))

    def test_noise_makes_nobody_the_fastest(self):
        for ms in ([1.05], [1.3, 0.8, 1.02], [0.99, 1.6]):
            said = self.said_of_windows({"a": [1.0], "b": ms})[0]
            self.assertRegex(said, "a and b are alike in speed: .* no more than noise")
        self.assertIn("they take about 1 ms", self.said_of_windows({"a": [1.0], "b": [1.0]})[0])
        self.assertIn("All 4 variants are alike", self.said_of_windows(
            {"a": [1.0], "b": [1.01], "c": [1.02], "d": [1.03]})[0])

    def test_those_who_are_alike_share_a_place(self):
        said = self.said_of_windows({"a": [1.0], "b": [1.03], "c": [2.0], "d": [2.05]})[0]
        self.assertEqual(said, "a and b solve a window fastest, in about 1 ms; c and d are "
                               "slowest, 2.0 × as long.")

    def test_windows_of_different_size_hide_no_difference(self):
        sizes = [0.2, 1.0, 5.0, 0.3, 2.0, 9.0]
        said = self.said_of_windows({"a": sizes, "b": [1.3 * ms for ms in sizes]}, windows=24)[0]
        self.assertIn("a solves a window fastest", said)

    def test_chance_is_that_of_a_coin(self):
        self.assertAlmostEqual(window_times.chance_at_most(1, 3), 0.5)
        self.assertAlmostEqual(window_times.chance_at_most(0, 6), 1 / 64)

    def test_one_kernel_is_one(self):
        times = {"a": [1.0], "b": [2.0], "tukey": [1.0], "huber": [1.0]}
        self.assertIn("tukey minimises another cost, so these two sentences leave it out.",
                      self.said_of_windows({name: times[name] for name in ("a", "b", "tukey")},
                                           kernels=("tukey",)))
        self.assertIn("huber and tukey minimise another cost, so this sentence leaves them out.",
                      self.said_of_windows({name: times[name] for name in ("huber", "a", "b", "tukey")},
                                           kernels=("tukey", "huber")))

    def test_a_comparison_that_was_cut_short_says_so(self):
        said = "did not finish"
        self.assertNotIn(said, self.draw())
        self.document["is_whole"] = False
        self.assertIn(said, self.draw())

    def test_runs_with_poses_at_other_times_are_not_said_to_be_equal(self):
        self.document["variants"][1]["free"]["poses_compared"] = 1
        said = " ".join(words.of_runs(
            [item for item in self.document["variants"] if item["name"] in ("plain", "twin")]))
        self.assertIn("twin: most poses are at other times", said)
        self.assertNotIn("equals", said)

    def test_errors_come_with_what_is_compared_and_what_makes_it_doubtful(self):
        text = self.draw()
        self.assertNotIn("in doubt", text)
        self.assertIn("–", self.row(text, "twin")[-1])
        for item in self.document["variants"]:
            item["free"].update(truth_pairs=258, truth_covered_share=0.3, truth_warnings=["in mm?"])
        self.document["warnings"] = ["line 3 is skipped", "all runs: in mm?"]
        text = self.draw()
        for said in ("Warning: line 3 is skipped", "Warning: all runs: in mm?",
                     "errors are those of the runs is in doubt"):
            self.assertIn(said, text)
        self.assertEqual(self.row(text, "twin")[-2:], ["0.0100 ?", "258 poses, 30 % of the time"])

    def test_times_count_from_the_start_and_not_from_1970(self):
        text = self.draw()
        self.assertIn("1.25", self.row(text, "rough"))
        self.assertIn("never", self.row(text, "twin"))
        self.assertNotIn("16000000", re.sub(r"base64,[^\"]*", "", text))

    def test_who_is_missing_in_a_figure_is_named_with_the_reason(self):
        text = self.draw()
        self.assertIn("Not shown: kernel_huber; their kernels change what is minimised", text)
        self.assertIn("Not shown: slow; they are at their lowest cost from the start", text)
        self.assertIn("Not shown: slow; they take more than 3 times as long as plain", text)

    def test_who_has_other_windows_is_told_to_be_compared_by_whole_runs(self):
        rough = self.document["variants"][2]
        del rough["lockstep"]
        rough["free"]["poses_compared"] = 1
        text = self.draw()
        self.assertIn("rough is not among the windows, as it changes more than how a window of "
                      "plain is solved, such as windows or segments themselves: only whole runs "
                      "compare it.", text)
        self.assertIn("rough: most poses are at other times than those of plain, as segments "
                      "differ. Only the few at the same times are compared, in the table below.",
                      text)
        self.assertIn("2 mm (1 of 3 poses)", self.row(text, "rough"))

    def test_a_figure_with_nothing_to_draw_is_left_out_and_said_to_be(self):
        slow = self.document["variants"][3]
        self.document["variants"] = [slow]
        text = self.draw()
        self.assertEqual(sorted(path.name for path in (self.folder / "figures").glob("*.svg")),
                         ["free.svg", "points.svg", "stages.svg"])
        for said in ("nothing to draw: Cost above the lowest", "nothing to draw: Share of the "
                     "windows", "Not shown: slow; they are at their lowest cost from the start"):
            self.assertIn(said, text)

    def test_whole_runs_alone_have_a_page(self):
        for item in self.document["variants"]:
            del item["lockstep"]
        text = self.draw()
        self.assertNotIn("The same windows", text)
        self.assertIn("Whole runs", text)

    def test_lengths_keep_two_digits_and_no_exponent(self):
        for metres, text in ((0, "≤ 1 nm"), (1e-12, "≤ 1 nm"), (1.4e-7, "140 nm"),
                             (5.14e-4, "510 µm"), (0.0044, "4.4 mm"), (0.05, "5.0 cm"),
                             (12.3, "12.3 m"), (9.996e-4, "1 mm")):
            self.assertEqual(words.small_length(metres), text)


if __name__ == "__main__":
    unittest.main()
