# SPDX-License-Identifier: MIT
"""Factors say what they mean, and designs are what their names promise and repeat themselves."""
import unittest

from support import FolderTest

from trajlo_batch.yaml_lines import SuiteError, load
from trajlo_experiment import designs
from trajlo_experiment.factors import read_factor


class ReadingTest(FolderTest):
    def read(self, text, name="f"):
        return read_factor(load(self.write("vary.yaml", f"{name}: {text}\n")), name)


class FactorTest(ReadingTest):
    def refuse(self, text, message):
        with self.assertRaisesRegex(SuiteError, message):
            self.read(text)

    def test_a_list_of_numbers_sets_its_own_key(self):
        factor = self.read("[2, 3]", "window.segments")
        self.assertEqual(factor.options(3), {"window.segments": "3"})
        self.assertEqual((factor.key, factor.scale, factor.label),
                         ("window.segments", "linear", "segments"))

    def test_units_of_keys_are_written_as_people_do(self):
        for key, label in (("a.voxel_size_m", "voxel size [m]"), ("a.rate_hz", "rate [Hz]"),
                           ("a.translation_m2_s3", "translation [m²/s³]"),
                           ("a.rotation_rad2_s3", "rotation [rad²/s³]"),
                           ("a.speed_mps", "speed [m/s]"), ("a.rate_rad_s", "rate [rad/s]"),
                           ("a.tilt_deg", "tilt [°]"), ("a.rings", "rings"), ("s", "s")):
            self.assertEqual(self.read("[2, 3]", key).label, label)

    def test_values_over_a_wide_range_are_taken_as_ratios(self):
        self.assertEqual(self.read("[0.01, 1]").scale, "log")
        self.assertEqual(self.read("{values: [0.01, 1], scale: linear}").scale, "linear")
        self.assertEqual(self.read("[0, 1]").scale, "linear")

    def test_texts_are_choices_and_numbers_that_yaml_takes_for_texts_are_numbers(self):
        self.assertEqual(self.read("[none, huber]").scale, "choice")
        self.assertEqual(self.read("[1e-3, 1e-2]").levels, (0.001, 0.01))

    def test_truth_values_are_choices_and_are_written_as_options_are(self):
        factor = self.read("[true, false]")
        self.assertEqual((factor.scale, factor.options(False)), ("choice", {"f": "false"}))

    def test_a_logarithmic_range_has_steps_of_equal_ratio(self):
        self.assertEqual(self.read("{from: 0.01, to: 1, steps: 3, scale: log}").levels,
                         (0.01, 0.1, 1.0))

    def test_a_range_of_whole_numbers_has_no_number_twice(self):
        self.assertEqual(self.read("{from: 1, to: 3, steps: 9, whole: true}").levels, (1, 2, 3))

    def test_one_number_can_drive_several_options(self):
        factor = self.read("{values: [0.1, 0.2], keys: {a.b: 1, c.d: 0.5}}")
        self.assertEqual(factor.options(0.2), {"a.b": "0.2", "c.d": "0.1"})
        self.assertIsNone(factor.key)

    def test_whole_numbers_are_written_without_a_point(self):
        factor = self.read("{values: [2, 3], keys: {a.b: 1, c.d: 2.0, e.f: 0.5, g.h: 12345}}")
        self.assertEqual(factor.options(2), {"a.b": "2", "c.d": "4", "e.f": "1", "g.h": "24690"})
        self.assertEqual(factor.options(3)["e.f"], "1.5")
        levels = self.read("{from: 2, to: 8, steps: 3}")
        self.assertEqual([levels.options(level)["f"] for level in levels.levels], ["2", "5", "8"])

    def test_names_can_stand_for_sets_of_options(self):
        factor = self.read("{settings: {ours: {}, papers: {expert.map.levels: 1, m.x: true}}}")
        self.assertEqual(factor.options("papers"), {"expert.map.levels": "1", "m.x": "true"})

    def test_what_makes_no_sense_is_refused_with_its_line(self):
        self.refuse("{from: 1}", "vary.yaml:1.*above its `from`")
        self.refuse("{from: 0, to: 1, scale: log}", "no logarithmic axis")
        self.refuse("{from: 1, to: 2, steps: 1}", "at least 2 steps")
        self.refuse("{values: [1], from: 1}", "one of values, from with to, settings")
        self.refuse("{value: [1]}", "mean values?")
        self.refuse("[1, 1.0]", "appears twice")
        self.refuse("[]", "no values")
        self.refuse("['a,b']", "without commas")
        self.refuse("3", "needs a list of values")

    def test_a_sampled_range_ends_at_its_ends(self):
        factor = self.read("{from: 0.01, to: 1, scale: log}")
        self.assertEqual([factor.sample(share) for share in (0.0, 0.5, 1.0)], [0.01, 0.1, 1.0])
        values = self.read("[1, 2, 3]")
        self.assertEqual([values.sample(share) for share in (0.0, 0.34, 1.0)], [1, 2, 3])


class DesignTest(ReadingTest):
    def setUp(self):
        super().setUp()
        self.factors = [self.read("{from: 1, to: 16, steps: 3, scale: log}", "a"),
                        self.read("[x, y]", "b")]

    def test_a_grid_has_all_combinations(self):
        points = designs.grid(self.factors)
        self.assertEqual(len(points), 6)
        self.assertEqual(points[1], {"a": 1.0, "b": "y"})

    def test_one_at_a_time_changes_one_and_repeats_no_centre(self):
        points = designs.one_at_a_time(self.factors, {"b": "y"}, {"a": 4})
        self.assertEqual(points, [{"b": "y"}, {"b": "y", "a": 1.0}, {"b": "y", "a": 16.0},
                                  {"b": "x"}])

    def test_sampled_designs_repeat_themselves_for_a_seed_only(self):
        for kind in designs.SAMPLED:
            with self.subTest(kind):
                first, again, other = (designs.sampled(kind, self.factors, 8, seed)
                                       for seed in (1, 1, 2))
                self.assertEqual(first, again)
                self.assertNotEqual(first, other)
                self.assertTrue(all(1 <= point["a"] <= 16 for point in first))
                self.assertEqual({point["b"] for point in first}, {"x", "y"})

    def test_a_latin_hypercube_has_one_sample_in_each_part_of_a_range(self):
        factor = self.read("{from: 0, to: 8}")
        points = designs.sampled("latin_hypercube", [factor], 8, 5)
        self.assertEqual(sorted(int(point["f"]) for point in points), list(range(8)))

    def test_more_random_or_sobol_samples_keep_those_that_were_there(self):
        for kind in ("random", "sobol"):
            few, many = (designs.sampled(kind, self.factors, count, 3) for count in (4, 16))
            self.assertEqual(many[:4], few)


if __name__ == "__main__":
    unittest.main()
