# SPDX-License-Identifier: MIT
"""The estimator: its results as arrays, and use at the wrong time."""
import copy
import pickle
import unittest
import warnings

import numpy as np

import trajlo
from support import FolderTest, room_points, room_scan, run_room

STAMP = 1_700_000_000_000_000_000


class ResultsTest(FolderTest):

    @classmethod
    def setUpClass(cls):
        cls.odometry = run_room(covariance=True)

    def test_a_sensor_at_rest_stays_where_it_is(self):
        trajectory = self.odometry.trajectory
        self.assertGreater(len(trajectory), 15)
        np.testing.assert_allclose(trajectory.poses,
                                   np.tile(np.eye(4), (len(trajectory), 1, 1)), atol=5e-3)

    def test_windows_are_a_table(self):
        windows = self.odometry.windows
        count = len(windows["index"])
        self.assertGreater(count, 15)
        self.assertEqual({len(column) for column in windows.values()}, {count})
        self.assertEqual(windows["points"].dtype, np.int64)
        self.assertEqual(windows["inlier_share"].dtype, np.float64)
        self.assertEqual(windows["flag_names"].dtype.kind, "U")
        np.testing.assert_allclose(windows["begin_s"], 1e-9 * windows["begin_ns"], atol=1e-6)
        np.testing.assert_array_equal(windows["index"], np.arange(count))

    def test_the_map_lies_on_the_walls(self):
        points = self.odometry.map
        self.assertGreater(len(points), 500)
        self.assertEqual(points.shape[1], 3)
        from_walls = np.abs(np.abs(points) - [4.0, 3.0, 1.5]).min(axis=1)
        self.assertLess(np.median(from_walls), 0.01)

    def test_covariances_belong_to_the_poses(self):
        covariances = self.odometry.covariances
        self.assertEqual(covariances.shape, (len(self.odometry.trajectory), 6, 6))
        np.testing.assert_allclose(covariances, covariances.transpose(0, 2, 1), atol=1e-12)
        self.assertGreater(np.linalg.eigvalsh(covariances[5]).min(), 0.0)
        with self.assertRaises(trajlo.StateError):
            run_room().covariances

    def test_counts(self):
        counts = self.odometry.point_counts
        self.assertEqual(counts["received"], 8 * 2000)
        self.assertEqual(counts["kept"], 8 * 2000)

    def test_before_the_first_scan_everything_is_empty(self):
        odometry = trajlo.Odometry(covariance=True)
        self.assertEqual(len(odometry.trajectory), 0)
        self.assertEqual(odometry.map.shape, (0, 3))
        self.assertEqual(odometry.covariances.shape, (0, 6, 6))
        windows = odometry.windows
        self.assertEqual(set(windows), set(self.odometry.windows))
        for name, column in windows.items():
            self.assertEqual(column.shape, (0,))
            self.assertEqual(column.dtype.kind, self.odometry.windows[name].dtype.kind)

    def test_arrays_in_place_of_a_scan_give_the_same(self):
        odometry = trajlo.Odometry({"threads": 1})
        for index in range(8):
            scan = room_scan(index)
            odometry.add(scan.points, scan.times_s, stamp_ns=scan.stamp_ns)
        odometry.finish()
        self.assertEqual(self.tum_of(odometry.trajectory), self.tum_of(self.odometry.trajectory))

    def test_scans_without_times_get_a_pose_each(self):
        odometry = trajlo.Odometry({"threads": 1})
        for index in range(6):
            odometry.add(room_points(seed=index), stamp_ns=STAMP + index * 100_000_000)
        odometry.finish()
        np.testing.assert_array_equal(odometry.trajectory.times_ns,
                                      STAMP + np.arange(6) * 100_000_000)


class MisuseTest(unittest.TestCase):

    def test_after_finish(self):
        odometry = run_room()
        for call in (lambda: odometry.add(room_scan(9)), odometry.finish):
            with self.assertRaisesRegex(trajlo.StateError, "is finished; make a new one"):
                call()
        self.assertTrue(odometry.is_finished)
        self.assertGreater(len(odometry.trajectory), 0)

    def test_nothing_to_work_with(self):
        empty, nan, near = trajlo.Odometry(), trajlo.Odometry(), trajlo.Odometry()
        for index in range(8):
            stamp_ns = STAMP + index * 100_000_000
            nan.add(np.full((100, 3), np.nan), np.linspace(0, 0.1, 100), stamp_ns=stamp_ns)
            near.add(np.zeros((100, 3)), np.linspace(0, 0.1, 100), stamp_ns=stamp_ns)
        unusable = "none of the 800 points can be used"
        for odometry, message in ((empty, "^no scan was added"), (nan, unusable), (near, unusable)):
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                with self.assertRaisesRegex(trajlo.InputError, message):
                    odometry.finish()
            self.assertTrue(odometry.is_finished)

    def test_empty_scans_and_missing_points_in_between_do_no_harm(self):
        odometry = trajlo.Odometry({"threads": 1})
        for index in range(8):
            scan = room_scan(index)
            points = scan.points.copy()
            points[::10] = np.nan
            odometry.add(points, scan.times_s, stamp_ns=scan.stamp_ns)
            odometry.add(np.empty((0, 3)), np.empty(0), stamp_ns=scan.stamp_ns + 1)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", trajlo.TrajloWarning)
            odometry.finish()
        self.assertEqual(odometry.point_counts["not_finite"], 8 * 200)
        np.testing.assert_allclose(odometry.trajectory.positions, 0.0, atol=5e-3)

    def test_a_lidar_whose_place_is_unknown(self):
        odometry = trajlo.Odometry()
        scan = room_scan(0)
        with self.assertRaisesRegex(trajlo.ConfigError, "sensor.T_body_lidar.*LiDAR 1"):
            odometry.add(scan.points, scan.times_s, stamp_ns=scan.stamp_ns, lidar=1)
        placed = trajlo.Odometry({"sensor.T_body_lidar": [{}, {}]})
        placed.add(scan.points, scan.times_s, stamp_ns=scan.stamp_ns, lidar=1)

    def test_extrinsics_that_are_right_stay_where_they_are(self):
        given = [{"translation_m": [0, 0, 0]}, {"translation_m": [0.5, 0, 0]}]
        odometry = trajlo.Odometry({"threads": 1, "sensor.T_body_lidar": given})
        for index in range(8):
            scan = room_scan(index)
            odometry.add(scan)
            odometry.add(trajlo.Scan(scan.points - [0.5, 0, 0], scan.times_s,
                                     stamp_ns=scan.stamp_ns, lidar=1))
        odometry.finish()
        (first, first_s), (second, second_s) = odometry.rig
        np.testing.assert_array_equal(first, np.eye(4))
        self.assertEqual(first_s, 0.0)
        np.testing.assert_allclose(second[:3, 3], [0.5, 0, 0], atol=5e-3)
        np.testing.assert_allclose(second[:3, :3], np.eye(3), atol=3e-3)
        self.assertAlmostEqual(second_s, 0.0, delta=3e-3)

    def test_places_of_lidars_that_never_speak_are_mentioned(self):
        with self.assertWarnsRegex(trajlo.TrajloWarning, "has the poses of 2 LiDARs"):
            run_room({"sensor.T_body_lidar": [{}, {}]})

    def test_arrays_without_times_are_doubted_once(self):
        def told(options, points_of):
            odometry = trajlo.Odometry({"threads": 1, **options})
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                for index in range(3):
                    odometry.add(points_of(index), stamp_ns=STAMP + index * 10**8)
            return [w for w in caught if "points have no times of their own" in str(w.message)]

        found = told({}, lambda index: room_points(seed=index))
        self.assertEqual(len(found), 1)
        self.assertTrue(issubclass(found[0].category, trajlo.TrajloWarning))
        self.assertIn(__file__, found[0].filename)
        self.assertEqual(told({"input.point_time": "none"}, lambda i: room_points(seed=i)), [])
        self.assertEqual(told({}, lambda index: np.empty((0, 3))), [])

    def test_times_of_another_unit_are_doubted_once(self):
        def told(factor, scans=15, options=None, lidar=0):
            odometry = trajlo.Odometry({"threads": 1, **(options or {})})
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                for index in range(scans):
                    scan = room_scan(index)
                    times_s = factor * scan.times_s
                    times_s[::100] = 50.0  # Strays are no unit.
                    odometry.add(scan.points, times_s, stamp_ns=scan.stamp_ns, lidar=lidar)
                odometry.finish()
            found = [w for w in caught if "make a sweep take" in str(w.message)
                     or "have one time" in str(w.message)]
            self.assertTrue(all(w.filename == __file__ for w in found))
            return [str(w.message) for w in found]

        for scans in (4, 15):
            found = told(1e-3, scans)
            self.assertEqual(len(found), 1)
            self.assertRegex(
                found[0], r"a sweep take 9\.\d*e-05 s, but stamps are 0.1 s apart \(LiDAR 0\)")
        self.assertRegex(told(20.0)[0], r"a sweep take 1\.9\d s")
        self.assertIn("one time", told(0.0)[0])
        self.assertEqual(told(1.0) + told(0.5) + told(1e-3, scans=2), [])
        self.assertEqual(told(1e-3, options={"input.point_time": "none"}), [])
        self.assertIn("(LiDAR 1)", told(
            1e-3, options={"sensor.T_body_lidar": [{}, {}]}, lidar=1)[0])

    def test_it_cannot_be_copied_but_its_trajectory_can(self):
        odometry = run_room()
        for call in (pickle.dumps, copy.copy, copy.deepcopy):
            with self.assertRaisesRegex(TypeError, "cannot be pickled or copied.*its trajectory"):
                call(odometry)
        again = pickle.loads(pickle.dumps(odometry.trajectory))
        self.assertEqual(again.flags.tolist(), odometry.trajectory.flags.tolist())

    def test_poses_that_nothing_holds_are_mentioned(self):
        odometry = trajlo.Odometry({"threads": 1})
        for index in range(8):
            scan = room_scan(index)
            floor = scan.points * [1.0, 1.0, 0.0] - [0.0, 0.0, 1.5]
            odometry.add(floor, scan.times_s, stamp_ns=scan.stamp_ns)
        with self.assertWarnsRegex(trajlo.TrajloWarning,
                                   "the points leave a direction open.*flag degenerate"):
            odometry.finish()

    def test_stamps_that_count_scans_are_mentioned(self):
        for step, warns in ((1, True), (100_000, True), (100_000_000, False)):
            odometry = trajlo.Odometry({"threads": 1, "input.point_time": "none"})
            for index in range(20):
                odometry.add(room_points(seed=index), stamp_ns=index * step)
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                odometry.finish()
            found = any("stamp_ns counts nanoseconds" in str(w.message) for w in caught)
            self.assertEqual(found, warns, step)

    def test_stamps_that_stand_still_are_a_partial_input(self):
        odometry = trajlo.Odometry({"threads": 1})
        for index in range(20):
            scan = room_scan(index)
            odometry.add(scan.points, scan.times_s, stamp_ns=STAMP)
        with self.assertWarns(trajlo.PartialInputWarning):
            odometry.finish()

    def test_a_scene_that_changes_altogether_is_lost(self):
        odometry = trajlo.Odometry({"threads": 1})
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            for index in range(40):
                random = np.random.default_rng(index)
                points = random.normal(0, 20, (2000, 3)) if index > 5 else room_points()
                odometry.add(points, np.linspace(0, 0.1, 2000), stamp_ns=STAMP + index * 10**8)
            odometry.finish()
        lost = [w for w in caught if issubclass(w.category, trajlo.LostWarning)]
        self.assertEqual(len(lost), 1)
        self.assertIn(__file__, lost[0].filename)
        self.assertIsNotNone(odometry.lost_at_ns)

    def test_arguments_that_are_none(self):
        odometry = trajlo.Odometry()
        for call in (lambda: odometry.add(),
                     lambda: odometry.add(room_points()),
                     lambda: odometry.add(None, stamp_ns=1),
                     lambda: odometry.add(room_scan(0), stamp_ns=1),
                     lambda: odometry.add(room_scan(0), lidar=1),
                     lambda: trajlo.Odometry(on_window=3),
                     lambda: trajlo.Odometry(on_pose="print")):
            with self.assertRaises((TypeError, trajlo.InputError)):
                call()
        self.assertEqual(odometry.point_counts["received"], 0)


if __name__ == "__main__":
    unittest.main()
