# SPDX-License-Identifier: MIT
"""The numbers behind the figures, also where runs have failed."""
import math
import unittest

from support import ROOT  # noqa: F401  makes the scripts importable

from trajlo_experiment import analysis


def rows_of(errors, mark=""):
    """Rows from {point: {group: [error of each seed]}}; None is a failure."""
    return [{"point": point, "group": group, "seed": seed, "e": error,
             "marks": "reference" if point == mark else "",
             "result": "x" if error is None else "ok"}
            for point, groups in errors.items() for group, values in groups.items()
            for seed, error in enumerate(values, 1)]


class QuantileTest(unittest.TestCase):
    def test_quantiles_are_linear_between_values(self):
        self.assertEqual(analysis.quantile([1, 2, 3, 5], 0.5), 2.5)
        self.assertEqual(analysis.quantile([3], 0.25), 3)
        self.assertTrue(math.isnan(analysis.quantile([math.nan], 0.5)))

    def test_failures_push_the_median_up_instead_of_leaving_it(self):
        self.assertEqual(analysis.median([1, 2, math.inf]), 2)
        self.assertEqual(analysis.median([1, math.inf, math.inf]), math.inf)
        self.assertEqual(analysis.median([1, math.inf]), math.inf)
        self.assertEqual(analysis.median([math.inf, math.inf]), math.inf)


class RateTest(unittest.TestCase):
    def test_the_interval_of_a_rate_is_wilsons(self):
        low, high = analysis.wilson(1, 10)
        self.assertAlmostEqual(low, 0.0179, places=3)
        self.assertAlmostEqual(high, 0.4042, places=3)
        self.assertEqual(analysis.wilson(0, 10)[0], 0.0)
        self.assertGreater(analysis.wilson(0, 10)[1], 0.2)


class ParetoTest(unittest.TestCase):
    def test_only_what_nothing_beats_in_both_is_on_the_front(self):
        costs, errors = [1, 2, 3, 4, 1], [5, 3, 4, 1, 6]
        self.assertEqual(analysis.pareto(costs, errors), [0, 1, 3])

    def test_who_is_cheaper_by_less_than_noise_is_not_on_the_front(self):
        self.assertEqual(analysis.pareto([100, 104, 103, 120], [5, 3, 4, 2.9]), [1, 3])

    def test_a_failure_is_never_on_the_front(self):
        self.assertEqual(analysis.pareto([1, 2], [math.inf, 1.0]), [1])


class RankTest(unittest.TestCase):
    def rank(self, errors, mark=""):
        return analysis.rank(rows_of(errors, mark), "e", "reference" if mark else "")

    def test_errors_are_relative_to_the_reference_and_scenarios_count_alike(self):
        best, reference = self.rank({
            "better": {"near": [0.5, 0.5, 0.5], "far": [20.0]},
            "same": {"near": [1.0, 1.0, 1.0], "far": [10.0]}}, mark="same")
        # Half of the error on one, twice on the other: three seeds do not outvote one.
        self.assertAlmostEqual(best.score, 1.0)
        self.assertAlmostEqual(reference.score, 1.0)

    def test_the_interval_holds_the_score_and_widens_with_the_spread(self):
        narrow, wide = (next(item for item in self.rank({
            "a": {"g": values}, "b": {"g": [1.0] * 4}}, mark="b") if item.point == "a")
            for values in ([0.9, 1.0, 1.1, 1.0], [0.5, 1.0, 2.0, 1.0]))
        for item in (narrow, wide):
            self.assertTrue(item.low <= item.score <= item.high)
        self.assertGreater(wide.high / wide.low, narrow.high / narrow.low)

    def test_one_that_is_better_on_every_seed_is_always_the_best(self):
        first, second = self.rank({"a": {"g": [0.1, 0.2, 0.9, 1]}, "b": {"g": [0.2, 0.3, 1, 2]}})
        self.assertEqual((first.point, first.best_share, second.best_share), ("a", 1.0, 0.0))

    def test_a_tie_is_what_differs_less_than_the_seeds_scatter_or_than_is_printed(self):
        def tie(one, other):
            first, second = self.rank({"a": one, "b": other})
            return analysis.is_tie(first, second)

        self.assertTrue(tie({"g": [1.0, 2.0]}, {"g": [1.0, 2.0]}))
        self.assertTrue(tie({"g": [1.0]}, {"g": [1.004]}))
        self.assertFalse(tie({"g": [1.0]}, {"g": [1.1]}))
        # Seeds differ much, and the settings always by the same.
        self.assertFalse(tie({"g": [1.0, 9.0]}, {"g": [1.1, 9.9]}))
        self.assertTrue(tie({"g": [1.0, 1.0, 1.0]}, {"g": [1.2, 0.9, 1.1]}))
        self.assertFalse(tie({"g": [1.0, 1.0]}, {"g": [1.0, None]}))

    def test_one_that_failed_comes_after_all_that_did_not(self):
        ranked = self.rank({"fast": {"g": [0.01, None]}, "steady": {"g": [1.0, 1.0]},
                            "lost": {"g": [None, None]}})
        self.assertEqual([item.point for item in ranked], ["steady", "fast", "lost"])
        self.assertEqual([item.failed for item in ranked], [0, 1, 2])
        self.assertEqual(ranked[1].score, math.inf)

    def test_one_that_is_not_finished_is_not_ranked(self):
        rows = rows_of({"a": {"g": [1.0, 1.0]}, "b": {"g": [0.5]}})
        self.assertEqual([item.point for item in analysis.rank(rows, "e", "")], ["a"])

    def test_an_interval_that_would_be_the_range_of_the_seeds_is_none(self):
        for groups, is_one in (({"g": [1.0, 2.0]}, False), ({"g": [1.0, 2.0, 3.0]}, False),
                               ({"g": [1.0, 2.0, 3.0, 4.0]}, True),
                               ({"g": [1.0, 2.0, 3.0], "h": [1.0, 2.0, 3.0]}, True),
                               ({"g": [1.0] * 9, "h": [1.0, 2.0]}, False)):
            item, _ = self.rank({"a": groups, "b": {name: [1.0] * len(values)
                                                    for name, values in groups.items()}}, mark="b")
            self.assertEqual((math.isfinite(item.low), math.isfinite(item.best_share)),
                             (is_one, is_one), groups)

    def test_errors_are_divided_only_where_the_reference_has_one(self):
        errors = {"a": {"g": [1.0, 50.0], "h": [4.0]}, "b": {"g": [3.0, 60.0], "h": [8.0]},
                  "r": {"g": [2.0, None], "h": [2.0]}}
        first, second, reference = self.rank(errors, mark="r")
        self.assertEqual([item.point for item in (first, second, reference)], ["a", "b", "r"])
        self.assertAlmostEqual(first.score, 1.0)  # half and twice: not 50 m of something else
        self.assertEqual((reference.failed, reference.score), (1, math.inf))
        found = analysis.reference_of(rows_of(errors, "r"), "e", "reference")
        self.assertEqual((found.errors, found.recordings, found.is_marked),
                         ({("g", 1): 2.0, ("h", 1): 2.0}, 3, True))

    def test_without_a_reference_or_where_it_always_failed_there_are_the_medians(self):
        rows = rows_of({"a": {"g": [1.0]}, "b": {"g": [3.0]}, "r": {"g": [None]}}, mark="r")
        for name in ("reference", ""):
            found = analysis.reference_of(rows, "e", name)
            self.assertEqual((found.errors, found.is_marked), ({("g", 1): 2.0}, False))

    def test_one_that_fails_where_the_reference_does_is_never_the_best(self):
        errors = {"r": {"g": [1.0] * 4 + [None]}, "a": {"g": [0.1] * 4 + [None]},
                  "b": {"g": [1.0] * 4 + [9.0]}}
        by_name = {item.point: item for item in self.rank(errors, mark="r")}
        self.assertEqual((by_name["a"].best_share, by_name["b"].best_share), (0.0, 1.0))


if __name__ == "__main__":
    unittest.main()
