# SPDX-License-Identifier: MIT
"""Windows as they were solved: their numbers fit together, and they can be weighed anew."""
import gc
import unittest
import weakref

import numpy as np

import trajlo
from support import run_room


def solved_windows(options=None, **more):
    windows = []
    odometry = run_room(options, on_solved=windows.append, **more)
    return odometry, windows


def step_of(window):
    """Gauss-Newton's next step: zero at a minimum."""
    return np.linalg.solve(window.H, -window.g)


def apart(a, b):
    return np.abs(a.poses - b.poses).max()


class InspectedTest(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.odometry, cls.windows = solved_windows()
        cls.window = cls.windows[-1]

    def test_they_are_those_of_the_run(self):
        table = self.odometry.windows
        self.assertEqual([w.index for w in self.windows], list(table["index"]))
        for window, begin_ns, end_ns, inliers in zip(
                self.windows, table["begin_ns"], table["end_ns"], table["inliers"]):
            self.assertEqual((window.times_ns[0], window.times_ns[-1]), (begin_ns, end_ns))
            self.assertEqual(len(window.points["weight"]), inliers)
        np.testing.assert_array_equal(self.odometry.trajectory.poses, run_room().trajectory.poses)

    def test_points_say_how_far_they_are_from_their_planes(self):
        points = self.window.points
        distance_m = (points["normal_world"] * points["p_world"]).sum(axis=1) - points["offset_m"]
        np.testing.assert_allclose(distance_m, points["distance_m"], atol=1e-12)
        sigma_m = np.array([s["sigma_m"] for s in self.window.segments])[points["segment"]]
        np.testing.assert_allclose(points["weight"] * points["kernel_weight"] / sigma_m**2,
                                   points["information"], rtol=1e-12)
        self.assertTrue(((points["t_ns"] >= self.window.times_ns[points["segment"]])
                         & (points["t_ns"] <= self.window.times_ns[points["segment"] + 1])).all())

    def test_normal_equations_are_the_sum_of_the_factors(self):
        window = self.window
        size = len(window.H)
        rest = window.H.copy()
        for term in window.motion + [dict(window.prior, first_pose=0)]:
            first, columns = 6 * term["first_pose"], term["jacobian"].shape[1]
            rest[first:first + columns, first:first + columns] -= (
                term["jacobian"].T @ term["jacobian"])
        # What is left is the registration: it moves with all poses along the points' normals.
        along = np.tile(np.r_[1.0, 0.0, 0.0, 0.0, 0.0, 0.0], size // 6)
        points = window.points
        seen = window.poses[0, :3, :3].T @ points["normal_world"].T
        expected = (points["information"] * seen[0]**2).sum()
        self.assertAlmostEqual(along @ rest @ along / expected, 1.0, delta=1e-3)

    def test_it_is_near_its_minimum_and_solving_it_ends_there(self):
        self.assertLess(np.abs(step_of(self.window)).max(), 5e-3)
        for solver in ("ceres", "gauss_newton"):
            solved = self.window.solve(solver=solver)
            self.assertLess(np.abs(step_of(solved)).max(), 1e-8)
            self.assertLessEqual(solved.costs[-1], solved.costs[0])
            self.assertEqual(solved.index, self.window.index)
        self.assertEqual(self.window.costs, [])

    def test_new_weights_have_a_minimum_of_their_own(self):
        usual = self.window.solve()
        for weights in ({"sigma_m": 1.0}, {"kernel": "huber", "kernel_m": 0.02},
                        {"translation_m2_s3": 1e-4}, {"rotation_rad2_s3": 1e-4},
                        {"prior_factor": 0.0}):
            window = self.window.solve(**weights)
            self.assertLess(np.abs(step_of(window)).max(), 1e-7, weights)
            self.assertGreater(apart(window, usual), 1e-8, weights)

    def test_points_can_be_weighed_one_by_one(self):
        weights = self.window.points["weight"]
        np.testing.assert_allclose(self.window.solve(point_weights=weights).poses,
                                   self.window.solve().poses, atol=1e-10)
        weights[::2] = 0.0
        half = self.window.solve(point_weights=weights)
        self.assertTrue((half.points["information"][::2] == 0.0).all())
        self.assertGreater(apart(half, self.window.solve()), 1e-7)

    def test_iterations_say_whether_there_were_enough(self):
        self.assertEqual(self.window.iterations, 0)
        self.assertEqual(self.window.solve(kernel="tukey", max_iterations=1).iterations, 1)
        self.assertLess(self.window.solve(kernel="tukey").iterations, 100)

    def test_weights_without_a_finite_solution_are_an_error(self):
        for solver in ("ceres", "gauss_newton"):
            with self.assertRaisesRegex(trajlo.EstimatorError, "has no finite solution"):
                self.window.solve(sigma_m=1e-200, solver=solver)

    def test_wrong_weights_are_refused(self):
        for weights in ({"sigma_m": 0.0}, {"prior_factor": -1.0}, {"point_weights": [1.0, 2.0]},
                        {"kernel_m": float("nan")}, {"max_iterations": 0}, {"point_weights": []},
                        {"max_iterations": 10**30}):
            with self.assertRaises(trajlo.InputError, msg=weights):
                self.window.solve(**weights)
        with self.assertRaisesRegex(trajlo.ConfigError, "^kernel: must be one of .* 'huber'"):
            self.window.solve(kernel="hubber")
        with self.assertRaisesRegex(trajlo.ConfigError, "^solver: must be one of ceres"):
            self.window.solve(solver="newton")

    def test_a_value_of_another_type_is_refused_by_name(self):
        for name in ("sigma_m", "kernel_m", "translation_m2_s3", "rotation_rad2_s3",
                     "prior_factor"):
            for value, found in (("1", "str"), ([1.0], "list"), (True, "bool"), (1j, "complex")):
                with self.assertRaisesRegex(
                        TypeError, f"^{name}: must be a number or None, found {found}$"):
                    self.window.solve(**{name: value})
        for name in ("kernel", "solver"):
            with self.assertRaisesRegex(TypeError, f"^{name}: must be a str or None, found int$"):
                self.window.solve(**{name: 3})
        for value, found in (("9", "str"), (9.0, "float"), (None, "NoneType"), (True, "bool")):
            with self.assertRaisesRegex(
                    TypeError, f"^max_iterations: must be a whole number, found {found}$"):
                self.window.solve(max_iterations=value)

    def test_numbers_of_numpy_are_numbers(self):
        usual = self.window.solve(sigma_m=0.5, max_iterations=3)
        same = self.window.solve(sigma_m=np.float32(0.5), max_iterations=np.int64(3))
        np.testing.assert_array_equal(same.poses, usual.poses)
        self.assertEqual(self.window.solve(sigma_m=1).index, usual.index)

    def test_a_misspelt_argument_comes_with_the_nearest(self):
        with self.assertRaisesRegex(TypeError, "has no argument 'sigma'; did you mean 'sigma_m'"):
            self.window.solve(sigma=1)
        with self.assertRaisesRegex(TypeError, "no argument 'temperature'; it has sigma_m, kernel"):
            self.window.solve(temperature=1)


class CallbackTest(unittest.TestCase):

    def test_what_it_throws_reaches_the_caller(self):
        def fail(window):
            raise ZeroDivisionError(window.index)
        with self.assertRaises(ZeroDivisionError):
            run_room(on_solved=fail)

    def test_a_finished_odometry_holds_no_callback(self):
        class Holder:
            def take(self, window):
                pass
        holder = Holder()
        odometry = run_room(on_solved=holder.take)
        gone = weakref.ref(holder)
        del holder
        gc.collect()
        self.assertIsNone(gone())
        self.assertTrue(odometry.is_finished)

    def test_no_callback_that_cannot_be_called(self):
        with self.assertRaises(TypeError):
            trajlo.Odometry(on_solved=3)


if __name__ == "__main__":
    unittest.main()
