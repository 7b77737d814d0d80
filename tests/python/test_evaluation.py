# SPDX-License-Identifier: MIT
"""evaluate() gives the numbers of trajlo_evaluate."""
import json
import unittest
import warnings

import numpy as np
from scipy.spatial.transform import Rotation

import trajlo
from support import FolderTest, run_command

BEGIN = 1_700_000_000_000_000_000


def path_of(seconds, noise, seed=1):
    """A bend of 3 m/s with normal noise."""
    random = np.random.default_rng(seed)
    t = np.arange(0.0, seconds, 0.05)
    poses = np.tile(np.eye(4), (len(t), 1, 1))
    poses[:, :3, :3] = Rotation.from_rotvec(
        np.c_[0 * t, 0 * t, 0.2 * t] + random.normal(0, noise, (len(t), 3))).as_matrix()
    poses[:, :3, 3] = np.c_[3 * t, np.sin(t), 0.1 * t] + random.normal(0, noise, (len(t), 3))
    return trajlo.Trajectory(BEGIN + np.round(1e9 * t).astype(np.int64), poses)


class EvaluationTest(FolderTest):

    def setUp(self):
        super().setUp()
        self.estimate, self.truth = self.folder / "estimate.tum", self.folder / "truth.tum"
        path_of(50.0, 0.05).save_tum(self.estimate)
        path_of(50.0, 0.0).save_tum(self.truth)

    def command(self, *flags):
        output = self.folder / "evaluation"
        run_command("trajlo_evaluate", self.estimate, self.truth, f"--output={output}",
                    "--overwrite", "--report=false", "--quiet", *flags)
        return json.loads((output / "evaluation.json").read_text())["estimates"][0]

    def test_the_numbers_of_the_command(self):
        for flags, arguments in [
                ([], {}),
                (["--alignment=sim3", "--rpe=5f,2s"], dict(alignment="sim3", rpe="5f,2s")),
                (["--association=nearest", "--rpe_all_pairs", "--rpe_tolerance=0.3"],
                 dict(association="nearest", rpe_all_pairs=True, rpe_tolerance=0.3)),
                (["--alignment=none", "--time_offset_s=0.2", "--truth_orientation=ignore"],
                 dict(alignment="none", time_offset_s=0.2, truth_orientation="ignore")),
                (["--estimate_time_offset", "--align_first=10s", "--diverged_m=0.001"],
                 dict(estimate_time_offset=True, align_first="10s", diverged_m=0.001)),
                (["--lever_arm=0.1,0.2,0.3"],
                 dict(T_body_truth=[[1, 0, 0, 0.1], [0, 1, 0, 0.2], [0, 0, 1, 0.3], [0, 0, 0, 1]])),
        ]:
            with self.subTest(flags):
                expected = self.command(*flags)
                result = trajlo.evaluate(self.estimate, self.truth, **arguments)
                for name in set(expected) - {"name", "errors_csv", "trajectory"}:
                    self.assertEqual(result[name], expected[name], name)

    def test_trajectories_in_memory_differ_by_the_digits_of_a_file(self):
        by_file = trajlo.evaluate(self.estimate, self.truth)
        by_memory = trajlo.evaluate(path_of(50.0, 0.05), path_of(50.0, 0.0))
        self.assertAlmostEqual(by_file["ate"]["translation_m"]["rmse"],
                               by_memory["ate"]["translation_m"]["rmse"], delta=1e-8)
        self.assertEqual(by_file["pairs"], by_memory["pairs"])
        self.assertGreater(by_memory["kitti"]["segments"], 0)

    def test_errors_are_those_of_the_statistics(self):
        result = trajlo.evaluate(self.estimate, self.truth)
        errors = result["errors"]
        distance = np.linalg.norm(
            errors["T_world_body"][:, :3, 3] - errors["T_world_truth"][:, :3, 3], axis=1)
        np.testing.assert_allclose(errors["translation_m"], distance, atol=1e-12)
        self.assertAlmostEqual(np.sqrt(np.mean(distance**2)),
                               result["ate"]["translation_m"]["rmse"], places=12)
        self.assertEqual(len(errors["t_ns"]), result["pairs"])

    def test_what_was_not_computed_is_none(self):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            result = trajlo.evaluate(path_of(5.0, 0.05), path_of(5.0, 0.0),
                                     truth_orientation="ignore")
        self.assertIsNone(result["kitti"])
        self.assertTrue(result["kitti_reason"])
        self.assertIsNone(result["ate"]["rotation_deg"])
        self.assertEqual(result["errors"]["rotation_deg"].shape, (0,))

    def test_a_run_that_diverged_says_so(self):
        good = path_of(50.0, 0.0)
        random = np.random.default_rng(1)
        poses = good.poses
        poses[:, :3, 3] += random.normal(0, 100, (len(good), 3))
        result = trajlo.evaluate(trajlo.Trajectory(good.times_ns, poses), good)
        self.assertTrue(result["diverged"])
        self.assertTrue(result["divergence_reason"])

    def test_what_cannot_be_compared(self):
        later = path_of(5.0, 0.0)
        later = trajlo.Trajectory(later.times_ns + 10**12, later.poses)
        empty = trajlo.Trajectory(np.empty(0, np.int64), np.empty((0, 4, 4)))
        for estimate in (later, empty):
            with self.assertRaises(trajlo.EvaluationError):
                trajlo.evaluate(estimate, self.truth)
        with self.assertRaises(trajlo.InputError):
            trajlo.evaluate(self.folder / "missing.tum", self.truth)
        with self.assertRaises(TypeError):
            trajlo.evaluate(None, self.truth)
        for message, wrong in [
                ("^alignment: must be one of", dict(alignment="se4")),
                ("^association: must be one of", dict(association="next")),
                ("^rpe: must be lengths", dict(rpe="1x")),
                ("^max_gap_s: must be between", dict(max_gap_s=-1.0)),
                ("^max_gap_s: must be between", dict(max_gap_s=float("nan"))),
                ("^min_completeness: must be a number", dict(min_completeness="half")),
                ("^rpe_tolerance: must be between", dict(rpe_tolerance=0.0)),
                ("^estimate_time_offset: must be True or False", dict(estimate_time_offset=2)),
                ("^format: must be", dict(format="csv")),
                ("^align_first: must be", dict(align_first="-3"))]:
            with self.subTest(message), self.assertRaisesRegex(trajlo.UsageError, message):
                trajlo.evaluate(self.estimate, self.truth, **wrong)
        with self.assertRaisesRegex(trajlo.InputError, "^time_offset_s: must be float64, found fl"):
            trajlo.evaluate(self.estimate, self.truth, time_offset_s=np.float32(1.6e9))
        for wrong in (np.ma.masked_array(np.eye(4)), np.eye(3), 2 * np.eye(4), np.full((4, 4), np.nan), "identity"):
            with self.assertRaisesRegex(trajlo.InputError, "^T_body_truth"):
                trajlo.evaluate(self.estimate, self.truth, T_body_truth=wrong)


if __name__ == "__main__":
    unittest.main()
