# SPDX-License-Identifier: MIT
"""What the page of an experiment says in sentences is true, also where runs failed."""
import types
import unittest

from pretended_findings import (GRID, ONE_AT_A_TIME, SAMPLED, SEQUENCES, FindingsTest, bowl)

from trajlo_experiment import conclusion, table
from trajlo_experiment.findings import Findings


class ConclusionTest(FindingsTest):
    def test_a_value_that_always_fails_matters_most(self):
        def error_of(levels, _, seed):
            return None if levels["a.kernel"] == "huber" else 0.01 * levels["a.sigma_m"]

        text = GRID[:GRID.index("marks")] + SEQUENCES
        sentences = conclusion.sentences(self.findings(text, error_of))
        self.assertIn("kernel matters most: 18 of 18 runs failed with kernel = huber, and no setting "
                      "with it ended well on all recordings.", sentences)

    def test_where_a_value_fails_more_often_that_is_said(self):
        def error_of(levels, group, seed):
            odd = levels["a.sigma_m"] == 1 and group == "spin_avia" and seed == 3
            return None if odd and levels["a.kernel"] == "huber" else 0.01

        text = GRID[:GRID.index("marks")] + SEQUENCES
        sentences = conclusion.sentences(self.findings(text, error_of))
        self.assertIn("No factor by itself changes the mean error of settings that never failed by "
                      "more than 5 %.", sentences)
        self.assertIn("1 of 12 runs failed with σ = 1 m, 0 of 12 with σ = 10 m.", sentences)

    def test_where_everything_failed_nothing_is_said_of_settings(self):
        findings = self.findings(GRID, lambda *_: None)
        self.assertEqual(conclusion.sentences(findings),
                         ["Settings are not compared: no run has ended well."])
        self.assertEqual(conclusion.caution(findings), "")

    def test_a_recording_on_which_all_settings_failed_is_left_out_and_that_is_said(self):
        def error_of(levels, group, seed):
            return None if group == "spin_avia" else 0.01 * levels["a.sigma_m"]

        findings = self.findings(GRID, error_of)
        sentences = conclusion.sentences(findings)
        self.assertEqual(sentences[0], (
            "On 3 recordings no run has ended well, and what follows leaves them out: Spin, Livox "
            "Avia, seed 1; Spin, Livox Avia, seed 2; Spin, Livox Avia, seed 3."))
        self.assertIn("σ matters most: between its values the mean error differs by a factor of "
                      "100.0.", sentences)
        self.assertFalse([text for text in sentences if "failed" in text])
        self.assertAlmostEqual(findings.ranked()[0].score, 0.1)
        self.assertEqual(findings.groups, ["hall_os1_16"])

    def test_settings_that_fail_on_another_recording_are_told_from_those_that_are_left_out(self):
        def error_of(levels, group, seed):
            lost = levels["a.sigma_m"] == 10 and seed == 2
            return None if lost or group == "spin_avia" else 0.01

        self.assertIn("2 of 7 settings failed on at least one other recording.",
                      conclusion.sentences(self.findings(GRID, error_of)))

    def test_failures_on_the_same_recordings_are_no_same_results(self):
        def only_the_mark(levels, *_):
            return 0.01 if levels["a.sigma_m"] == 3 else None

        sentences = conclusion.sentences(self.findings(GRID, only_the_mark))
        self.assertIn("The best of 7 settings is “other”", sentences[0])
        self.assertFalse([text for text in sentences if "no effect" in text or "matters" in text
                          or "No factor" in text])

    def test_the_same_errors_and_the_same_failures_are_the_same_results(self):
        def error_of(levels, group, seed):
            return None if seed == 1 and levels["a.sigma_m"] < 5 else 0.01 * levels["a.sigma_m"]

        self.assertIn("kernel has no effect here",
                      " ".join(conclusion.sentences(self.findings(GRID, error_of))))

    def test_where_no_setting_ended_well_everywhere_nothing_is_said_of_means(self):
        def error_of(levels, group, seed):
            return None if (seed == 1) == (levels["a.kernel"] == "huber") else 0.01

        sentences = conclusion.sentences(self.findings(GRID, error_of))
        self.assertEqual(sentences[0], "No setting ended well on all recordings.")
        self.assertFalse([text for text in sentences if "mean error" in text or "matters" in text])
        self.assertIn("12 of 18 runs failed with kernel = none, 6 of 18 with kernel = huber.",
                      sentences)

    def test_a_metric_that_no_run_has_is_named(self):
        metric = "metric: kitti_translation_percent\n"
        self.assertEqual(conclusion.sentences(self.findings(GRID + metric)), [
            "Settings are not compared: no run that ended well has kitti_translation_percent."])

    def test_of_an_unfinished_grid_no_factor_matters_most(self):
        batch = self.batch(GRID)
        self.finish(batch, bowl)
        for run in batch.runs:
            if "kernel = huber" in run.configuration.label and "σ = 10 m" in run.configuration.label:
                (self.places.output / run.folder / "status.json").unlink()
        sentences = conclusion.sentences(Findings(batch.suite, table.collect(batch)))
        self.assertIn("1 of 7 settings is not compared: it has not ended on all recordings yet.",
                      sentences)
        self.assertFalse([text for text in sentences if "matters most" in text])

    def test_of_one_factor_nobody_says_that_it_matters_most(self):
        text = GRID[:GRID.index("  a.kernel")] + SEQUENCES
        sentences = conclusion.sentences(self.findings(text, lambda levels, *_: 0.01 * levels["a.sigma_m"]))
        self.assertIn("σ matters: between its values the mean error differs by a factor of 100.0.",
                      sentences)

    def sampled(self, samples, error_of):
        text = SAMPLED.replace("samples: 16", f"samples: {samples}")
        return [text for text in conclusion.sentences(self.findings(text, error_of))
                if "matter" in text]

    def test_a_range_with_few_samples_is_judged_in_parts(self):
        said, = self.sampled(16, lambda levels, *_: 0.01 * levels["a.sigma_m"] ** 0.5)
        self.assertRegex(said, "^sigma matters most: between parts of its range the mean error "
                         "differs by a factor of [67]")

    def test_from_samples_that_differ_by_chance_no_factor_matters(self):
        values = [0.01 * (1 + 3 * (i * 0.618 % 1)) for i in range(64)]
        told = {}

        def error_of(levels, *_):
            return values[told.setdefault(str(levels), len(told))]

        for samples in (4, 8, 16):
            said = self.sampled(samples, error_of)
            self.assertIn(f"From {samples} samples it cannot be told which factor matters", said[0])

    def test_where_the_reference_failed_nothing_is_divided_by_it_and_that_is_said(self):
        def error_of(levels, group, seed):
            lost = levels == {"a.sigma_m": 1, "a.kernel": "huber"} and seed == 3
            return None if lost else 0.01

        findings = self.findings(GRID, error_of)
        self.assertEqual(findings.ratio_label, "error / error of paper, on 4 of 6 recordings")
        self.assertIn("The error of the first of them, on 4 of 6 recordings, is as high as that of "
                      "“paper”", conclusion.sentences(findings)[1])

    def test_the_conclusion_names_the_best_setting_and_the_factor_that_matters(self):
        sentences = conclusion.sentences(self.findings(GRID))
        self.assertEqual(sentences[0], "None of 7 settings is the best: 2 tie, (σ = 1 m, kernel = "
                         "none), (σ = 1 m, kernel = huber); they gave exactly the same results. "
                         "“paper” is among them.")
        self.assertEqual(sentences[1], "kernel has no effect here: settings that differ in it "
                         "alone gave exactly the same results.")
        self.assertIn("σ matters most: 2 of 12 runs failed with σ = 10 m, and no setting with it "
                      "ended well on all recordings.", sentences)
        self.assertIn("Between its other values the mean error differs by a factor of 2.0.",
                      sentences)
        self.assertIn("2 of 7 settings failed on at least one recording.", sentences)

    def test_what_the_seeds_scatter_more_than_it_differs_is_a_tie(self):
        def error_of(levels, group, seed):
            none = levels["a.kernel"] == "none"
            return 0.01 * levels["a.sigma_m"] * (1 + (0.1 * (seed - 1.9) if none else 0.0))

        sentences = conclusion.sentences(self.findings(GRID, error_of))
        self.assertIn("2 tie, (σ = 0.1 m, kernel = huber), (σ = 0.1 m, kernel = none); their errors "
                      "differ by less than seeds scatter", sentences[0])
        self.assertIn("The error of the first of them is 90 % lower than that of “paper”",
                      sentences[1])
        self.assertFalse(any("no effect" in sentence for sentence in sentences))
        clear = self.findings(GRID, lambda levels, _, seed: 0.01 * seed * levels["a.sigma_m"] * (
            2 if levels["a.kernel"] == "none" else 1))
        self.assertIn("The best of 7 settings is σ = 0.1 m, kernel = huber.",
                      conclusion.sentences(clear)[0])

    def test_an_option_that_a_mark_sets_otherwise_than_its_factors_is_named(self):
        text = ONE_AT_A_TIME.replace("sequences", "marks: {odd: {rules: theirs, c.d: 7}}\nsequences")
        findings = self.findings(text)
        self.assertEqual(conclusion.setting_text(findings, findings.marks["odd"]),
                         "“odd”: sigma = 1 m, b = 2, rules = theirs, c.d = 7")

    def test_the_best_may_be_the_reference_itself(self):
        worse = self.findings(GRID, lambda levels, *_: 0.01 if levels == {
            "a.sigma_m": 1, "a.kernel": "huber"} else 0.02)
        self.assertEqual(conclusion.sentences(worse)[0], "The best of 7 settings is σ = 1 m, "
                         "kernel = huber. That is “paper”.")

    def test_sigmas_that_vary_while_the_weights_tune_themselves_are_no_sweep(self):
        def plan_of(options, varied):
            factors = [types.SimpleNamespace(keys={key: None}, settings={}) for key in varied]
            point = types.SimpleNamespace(name="a", in_design=True)
            runs = [types.SimpleNamespace(options=options, configuration=point),
                    types.SimpleNamespace(options=tuned, configuration=mark)]
            return types.SimpleNamespace(runs=runs, suite=types.SimpleNamespace(
                factors=factors, points=[point, mark]))

        mark = types.SimpleNamespace(name="b", in_design=False)
        tuned, fixed = "motion_prior: {self_tuning: true}", "motion_prior: {self_tuning: false}"
        density = "expert.motion_prior.translation_m2_s3"
        self.assertIn(f"sweep of {density} while", conclusion.warnings(plan_of(tuned, [density]))[0])
        for options, varied in ((fixed, [density]), (tuned, ["expert.registration.kernel"]),
                                (tuned, [density, "motion_prior.self_tuning"]), ("", [density])):
            self.assertEqual(conclusion.warnings(plan_of(options, varied)), [])


if __name__ == "__main__":
    unittest.main()
