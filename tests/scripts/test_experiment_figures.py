# SPDX-License-Identifier: MIT
"""Figures and pages of experiments show what happened, also what failed."""
import json
import math
import re
import subprocess
import unittest

from pretended_findings import GRID, ONE_AT_A_TIME, SAMPLED, FindingsTest, bowl
from support import SCRIPTS

from trajlo_batch import plan
from trajlo_experiment import (conclusion, experiment_report, figures_heat, figures_sensitivity,
                               table)
from trajlo_experiment.figures_parallel import axis_ticks, height_on_axis, spread_ticks
from trajlo_experiment.figures_tornado import draw_tornado, swings
from trajlo_experiment.figures_tradeoff import draw_pareto, tradeoff
from trajlo_experiment.findings import Findings
from trajlo_report import theme


class FiguresTest(FindingsTest):
    def test_a_cell_is_the_median_over_its_seeds_in_centimetres(self):
        findings = self.findings(GRID)
        across, upwards = findings.study.factors
        values, failed = figures_heat.cells(findings, findings.design, "spin_avia", across, upwards,
                                            [0.1, 1, 10], ["none", "huber"])
        self.assertEqual(values.round(6).tolist(), [[8, 4, 8], [8, 4, 8]])
        self.assertEqual(failed.tolist(), [[0, 0, 1], [0, 0, 1]])

    def test_marks_lie_between_the_levels_of_a_logarithmic_axis(self):
        findings = self.findings(GRID)
        across, _ = findings.study.factors
        place = figures_heat.place_among(across, 10 ** 0.5, [0.1, 1, 10])
        self.assertAlmostEqual(place, 1.5)
        self.assertIsNone(figures_heat.place_among(across, 20, [0.1, 1, 10]))

    def test_a_mark_beside_the_design_is_shown_and_not_mixed_in(self):
        findings = self.findings(GRID)
        self.assertEqual([item.center for item in findings.bins(findings.study.factors[0])],
                         [0.1, 1, 10])
        self.assertEqual(findings.marks["other"]["a.sigma_m"], 3)

    def test_one_at_a_time_compares_only_what_differs_in_one_factor(self):
        findings = self.findings(ONE_AT_A_TIME)
        sigma = findings.study.factors[0]
        self.assertEqual([(item.center, len(item.rows)) for item in findings.bins(sigma)],
                         [(0.1, 6), (1, 6), (10, 6)])
        self.assertEqual({row["a.b"] for item in findings.bins(sigma) for row in item.rows}, {2})

    def test_swings_are_relative_to_the_centre(self):
        found = dict(swings(self.findings(ONE_AT_A_TIME)))
        (text, low), (_, high) = found["sigma [m]"]
        self.assertEqual((text, round(low.score, 6), high.score), ("0.1", 2.0, math.inf))
        self.assertAlmostEqual(found["rules: theirs"][0][1].score, 2.0)

    def test_a_tornado_has_the_widest_swing_on_top(self):
        findings = self.findings(ONE_AT_A_TIME)
        axes, = draw_tornado(findings).axes
        labels = [label.get_text() for label in axes.get_yticklabels()]
        self.assertEqual(labels, ["b", "rules: theirs", "sigma [m]"])

    def test_the_front_of_error_and_time_leaves_out_what_is_beaten(self):
        findings = self.findings(ONE_AT_A_TIME)
        names, costs, errors, front = tradeoff(findings, "hall_os1_16")
        self.assertEqual(len(names), 6)
        self.assertEqual([(costs[i], round(errors[i], 6)) for i in front],
                         [(500.0, 2.2), (750.0, 2.0)])

    def test_a_sampled_range_falls_into_parts_with_all_its_rows(self):
        findings = self.findings(SAMPLED)
        bins = findings.bins(findings.study.factors[0])
        self.assertEqual(sum(len(item.rows) for item in bins), 16 * 6)
        self.assertLessEqual(len(bins), 6)
        for samples, parts in ((4, 2), (8, 2), (64, 6)):
            text = SAMPLED.replace("samples: 16", f"samples: {samples}")
            findings = self.findings(text)
            bins = findings.bins(findings.study.factors[0])
            self.assertEqual([len(item.rows) // 6 for item in bins][:2],
                             [math.ceil(samples / parts)] * 2)
            self.assertEqual((len(bins), sum(len(item.rows) for item in bins)), (parts, samples * 6))

    def test_values_that_somebody_chose_for_samples_stay_apart(self):
        findings = self.findings(SAMPLED.replace("{from: 0.1, to: 10, scale: log}", str(
            [value / 10 for value in range(1, 15)])).replace("{from: 1, to: 3}",
                                                             "{from: 1, to: 5, whole: true}"))
        sigma, whole = (findings.bins(factor) for factor in findings.study.factors[:2])
        self.assertEqual([item.label for item in sigma][:3], ["0.1", "0.2", "0.3"])
        self.assertEqual([item.label for item in whole], ["1", "2", "3", "4", "5"])

    def test_an_axis_of_the_parallel_plot_runs_from_its_least_to_its_most(self):
        findings = self.findings(GRID)
        sigma, kernel = findings.study.factors
        for level, height in ((0.1, 0.0), (1, 0.5), (10, 1.0)):
            self.assertAlmostEqual(height_on_axis(findings, sigma, level), height)
        self.assertEqual(height_on_axis(findings, kernel, "huber"), 1.0)

    def test_where_nothing_failed_there_is_no_figure_of_failures(self):
        findings = self.findings(GRID, lambda *_: 0.1)
        self.assertIsNone(figures_sensitivity.draw_failures(findings))

    def report(self, text, error_of=bowl):
        batch = self.batch(text)
        self.finish(batch, error_of)
        experiment_report.write_report(batch)
        self.assert_self_contained(self.places.output / "report.html")
        drawn = {path.name for path in (self.places.output / "figures").iterdir()}
        stems = {name.partition(".")[0] for name in drawn}
        self.assertEqual({f"{stem}.{kind}" for stem in stems for kind in theme.FORMATS},
                         drawn)
        return ({name.removesuffix(".png") for name in drawn if name.endswith(".png")},
                re.sub(r"base64,[^\"]*", "", (self.places.output / "report.html").read_text()))

    def test_one_seed_gives_no_intervals(self):
        once = GRID.replace("seeds: [1, 2, 3]", "seeds: [1]")
        _, text = self.report(once)
        self.assertIn("There are too few seeds", text)
        self.assertNotIn("95 %", text)
        self.assertNotIn("wins", text)
        findings = self.findings(once)
        self.assertFalse(findings.has_intervals)
        for ranked in findings.ranked():
            self.assertTrue(math.isnan(ranked.low) and math.isnan(ranked.best_share))
        axes, = draw_tornado(self.findings(
            ONE_AT_A_TIME.replace("seeds: [1, 2, 3]", "seeds: [1]"))).axes
        self.assertEqual([line for line in axes.lines if len(set(line.get_ydata())) == 1
                          and len(line.get_xdata()) > 1 and set(line.get_xdata()) != {1.0}], [])
        _, text = self.report(GRID)
        self.assertIn("95 % interval", text)

    def test_two_seeds_give_no_intervals(self):
        _, text = self.report(GRID.replace("seeds: [1, 2, 3]", "seeds: [1, 2]"))
        self.assertIn("There are too few seeds", text)
        self.assertNotIn("95 %", text)

    def test_a_mark_is_told_from_the_reference_by_its_name_and_options_in_text_and_figures(self):
        text = GRID.replace("other: {a.sigma_m: 3", "tuned: {a.tuned: true, a.sigma_m: 1")
        batch = self.batch(text)
        self.finish(batch, bowl)
        for run in batch.runs:
            if "tuned" in run.configuration.label:
                self.write_run(run, 0.001, 1.0)
        theme.apply()
        findings = Findings(batch.suite, table.collect(batch))
        self.assertIn("The best of 7 settings is “tuned”: σ = 1 m, kernel = huber, a.tuned = true.",
                      conclusion.sentences(findings)[0])
        across, upwards = findings.study.factors
        for figure in (figures_heat.draw_heat_map(findings, across, upwards, None),
                       figures_sensitivity.draw_sensitivity(findings)):
            figure.canvas.draw()
            drawn = [line for line in figure.axes[0].lines if line.get_marker() in ("D", "*")]
            self.assertEqual({line.get_marker() for line in drawn}, {"D", "*"})
            one, other = (line.get_transform().transform(line.get_xydata())[0] for line in drawn)
            self.assertGreater(math.dist(one, other) * 72 / figure.dpi, 5)

    def test_ticks_of_the_parallel_plot_never_lie_on_each_other(self):
        ticks = [(0.0, "a"), (0.01, "b"), (0.5, "c"), (0.55, "d"), (0.97, "e"), (1.0, "f")]
        self.assertEqual([text for _, text in spread_ticks(ticks, 0.07)], ["a", "c", "f"])
        findings = self.findings(SAMPLED)
        for factor in findings.study.factors:
            heights = sorted(height for height, _ in axis_ticks(findings, factor))
            self.assertTrue(all(high - low >= 0.07 for low, high in zip(heights, heights[1:])))

    def test_figures_have_titles_for_people(self):
        drawn, _ = self.report(GRID)
        for name in drawn - {"parallel"}:
            text = (self.places.output / "figures" / f"{name}.svg").read_text()
            self.assertIn("Hall, OS1-16", text)
            self.assertNotIn("hall_os1_16", text)

    def test_a_grid_has_all_figures_but_the_tornado(self):
        drawn, text = self.report(GRID)
        self.assertEqual(drawn, {"heat_map", "sensitivity", "levels_a_kernel", "failures", "pareto",
                                 "parallel"})
        self.assertIn("x: too far", text)
        self.assertIn("2 with an x", text)

    def test_one_at_a_time_has_a_tornado_and_no_map(self):
        drawn, text = self.report(ONE_AT_A_TIME)
        self.assertEqual(drawn, {"tornado", "sensitivity", "levels_rules", "failures", "pareto"})
        # The centre is ranked first: the table has it with its mark.
        self.assertRegex(text, r'<tr class="best"><td>1</td>.*center')

    def test_a_sampled_design_has_a_map_of_points(self):
        drawn, _ = self.report(SAMPLED)
        self.assertIn("heat_map", drawn)

    def test_when_everything_fails_the_page_says_so(self):
        drawn, text = self.report(GRID, lambda *_: None)
        self.assertIn("42 with an x", text)
        self.assertEqual(drawn, set())
        self.assertNotIn("<h2>Best settings</h2>", text)

    def test_a_recording_that_leaves_nothing_takes_no_part_in_figures(self):
        batch = self.batch(GRID)
        self.finish(batch, bowl)
        for run in batch.runs:
            if run.sequence.group == "spin_avia":
                status = self.places.output / run.folder / "status.json"
                status.write_text(json.dumps({**json.loads(status.read_text()), "exit_code": 2,
                                              "reason": "input unreadable", "cpu_s": None}))
        experiment_report.write_report(batch)
        text = (self.places.output / "figures" / "pareto.svg").read_text()
        self.assertIn("Hall, OS1-16", text)
        self.assertNotIn("Spin", text)

    def test_a_scenario_without_times_has_no_panel_of_times(self):
        findings = self.findings(GRID)
        for row in findings.rows:
            if row["group"] == "spin_avia":
                row["cpu_ms_per_data_second"] = None
        self.assertEqual([axes.get_title() for axes in draw_pareto(findings).axes], ["Hall, OS1-16"])

    def test_of_an_unfinished_experiment_the_finished_runs_are_shown(self):
        batch = self.batch(GRID)
        plan.write_plan(batch, keep_recordings=True)
        for run in batch.runs[:13]:
            self.write_run(run, 0.1, 1.0)
        rows = experiment_report.write_report(batch)
        self.assertEqual(experiment_report.summary(rows), "13 ended well, 29 not finished")
        self.assertTrue((self.places.output / "figures" / "heat_map.svg").is_file())

    def test_runs_of_other_options_are_not_compared_and_that_is_said(self):
        self.finish(self.batch(GRID), bowl)
        batch = self.batch(GRID + "defaults: {set: {window.segments: 9}}\n")
        rows = experiment_report.write_report(batch)
        self.assertEqual({row["outdated"] for row in rows}, {"options"})
        self.assertEqual(Findings(batch.suite, rows).rows, [])
        page = (self.places.output / "report.html").read_text()
        self.assertIn("Outdated: 42 of 42 runs; changed since: options. Without --report the", page)
        self.assertNotIn("<h2>Best settings</h2>", page)
        done = subprocess.run(
            [SCRIPTS / "experiment", batch.suite.file, "--build", self.places.build, "--output",
             self.places.output, "--report"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("Outdated: 42 of 42 runs", done.stdout)

    def test_what_is_in_doubt_has_its_sign_and_its_reason_and_is_no_failure(self):
        batch = self.batch(GRID)
        self.finish(batch, bowl)
        unsure, doubtful = (self.places.output / run.folder for run in batch.runs[:4:3])
        path = unsure / "evaluation" / "evaluation.json"
        path.write_text(json.dumps({**json.loads(path.read_text()),
                                    "warnings": ["/a/trajectory.tum: another unit"]}))
        status = doubtful / "status.json"
        status.write_text(json.dumps({**json.loads(status.read_text()), "exit_code": 3,
                                      "reason": "input damaged"}))
        experiment_report.write_report(batch)
        page = (self.places.output / "report.html").read_text()
        self.assertIn("of which 1 with warnings about the input, 1 with warnings about the "
                      "comparison with the truth", page)
        self.assertIn("!: a run ended with exit code 3", page)
        self.assertRegex(page, ">4.0 [?]</td><td[^>]*>8.0 !</td>")  # of the best settings
        for sign, reason in (("?", "trajectory.tum: another unit"), ("!", "input damaged")):
            row, = re.findall(rf"<tr[^>]*>(?=<td>\d+</td><td>\S+-seed\d</td><td>ok [{sign}]).*", page)
            self.assertIn(f"{reason}</td></tr>", row)
            self.assertTrue(row.startswith("<tr><td>"), "a run that ended well is no failure")

    def test_truth_values_are_written_as_options_are(self):
        _, text = self.report(GRID.replace("[none, huber]", "[true, false]").replace(
            "a.kernel: huber", "a.kernel: true"))
        self.assertRegex(text, '<td class="text long">true, false<')
        self.assertNotIn("True", text)

    def test_an_experiment_that_has_not_begun_has_a_page(self):
        batch = self.batch(GRID)
        experiment_report.write_report(batch)
        self.assert_self_contained(self.places.output / "report.html")

    def test_the_same_results_give_the_same_figures(self):
        self.report(GRID)
        path = self.places.output / "figures" / "heat_map.svg"
        first = path.read_bytes()
        self.report(GRID)
        self.assertEqual(re.sub(rb"clip-path.*", b"", path.read_bytes()),
                         re.sub(rb"clip-path.*", b"", first))


if __name__ == "__main__":
    unittest.main()
