# SPDX-License-Identifier: MIT
"""The estimator: its results as arrays, callbacks, threads, and use at the wrong time."""
import copy
import pickle
import sys
import threading
import time
import unittest
import warnings
import weakref

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


class CallbackTest(FolderTest):

    def test_windows_and_poses_are_told_as_they_come(self):
        windows, poses = [], []
        odometry = run_room(on_window=windows.append, covariance=True,
                            on_pose=lambda t_ns, T, covariance: poses.append((t_ns, T, covariance)))
        for name, column in odometry.windows.items():
            self.assertEqual([window[name] for window in windows], column.tolist())
        self.assertEqual([t_ns for t_ns, _, _ in poses], odometry.trajectory.times_ns.tolist())
        np.testing.assert_array_equal([T for _, T, _ in poses], odometry.trajectory.poses)
        np.testing.assert_array_equal([c for _, _, c in poses], odometry.covariances)

    def test_what_a_callback_raises_comes_out_and_harms_nothing(self):
        plain = run_room()
        calls = []

        def on_window(window):
            calls.append(window)
            if len(calls) in (3, 7):
                raise KeyError(len(calls))

        odometry = trajlo.Odometry({"threads": 1}, on_window=on_window)
        raised = []
        for step in [lambda i=i: odometry.add(room_scan(i)) for i in range(8)] + [odometry.finish]:
            try:
                step()
            except KeyError as error:
                raised.append(error.args[0])
        self.assertEqual(raised, [3, 7])
        self.assertEqual(self.tum_of(odometry.trajectory), self.tum_of(plain.trajectory))
        # The windows after the error of a scan are not told, but kept.
        self.assertEqual(len(odometry.windows["index"]), len(plain.windows["index"]))

    def test_finish_finishes_whatever_a_callback_raises(self):
        def on_pose(t_ns, T, covariance):
            raise KeyError(t_ns)

        odometry = trajlo.Odometry({"threads": 1}, on_pose=on_pose)
        for index in range(8):
            try:
                odometry.add(room_scan(index))
            except KeyError:
                pass
        with self.assertRaises(KeyError):
            odometry.finish()
        self.assertTrue(odometry.is_finished)
        with self.assertRaises(trajlo.StateError):
            odometry.finish()
        self.assertEqual(self.tum_of(odometry.trajectory), self.tum_of(run_room().trajectory))

    def test_callbacks_do_not_keep_a_finished_odometry(self):
        odometry = trajlo.Odometry({"threads": 1}, on_window=lambda window: odometry.trajectory)  # noqa: F821
        for index in range(4):
            odometry.add(room_scan(index))
        odometry.finish()
        held = weakref.ref(odometry)
        del odometry
        self.assertIsNone(held())

    def test_a_callback_may_look_but_not_add(self):
        seen, refused = [], []

        def on_window(window):
            seen.append((len(odometry.trajectory), len(odometry.map)))
            for call in (odometry.finish, lambda: odometry.add(room_scan(0))):
                try:
                    call()
                except trajlo.StateError as error:
                    refused.append(str(error))

        odometry = trajlo.Odometry({"threads": 1}, on_window=on_window)
        for index in range(6):
            odometry.add(room_scan(index))
        odometry.finish()
        self.assertEqual(len(refused), 2 * len(seen))
        self.assertIn("is computing", refused[0])
        self.assertGreater(seen[-1][0], seen[0][0])


class ThreadsTest(unittest.TestCase):

    def test_others_run_while_it_computes(self):
        """With such a switch interval, nobody else runs unless the GIL is given away."""
        counted = [0]
        stop = threading.Event()

        def count():
            while not stop.is_set():
                counted[0] += 1
                time.sleep(1e-4)

        interval = sys.getswitchinterval()
        sys.setswitchinterval(1000.0)
        other = threading.Thread(target=count)
        try:
            other.start()
            odometry = trajlo.Odometry({"threads": 1})
            before = counted[0]
            for index in range(200):
                odometry.add(room_scan(index))
                if counted[0] > before:
                    break
            self.assertGreater(counted[0], before)
        finally:
            stop.set()
            sys.setswitchinterval(interval)
            other.join()

    def test_another_thread_that_computes_is_refused_and_one_that_reads_is_not(self):
        """The callback waits, so that the other thread certainly comes in between: were the reads
        to wait for the call around the callback, both would for ever."""
        inside, looked = threading.Event(), threading.Event()
        errors, read = [], []

        def on_window(window):
            inside.set()
            looked.wait(60)

        odometry = trajlo.Odometry({"threads": 1}, on_window=on_window)

        def look():
            inside.wait(60)
            for call in (lambda: odometry.trajectory, lambda: odometry.map,
                         lambda: odometry.windows, lambda: odometry.point_counts,
                         lambda: odometry.add(room_scan(0)), odometry.finish):
                try:
                    read.append(call())
                except trajlo.StateError as error:
                    errors.append(str(error))
            looked.set()

        other = threading.Thread(target=look)
        other.start()
        for index in range(6):
            odometry.add(room_scan(index))
        odometry.finish()
        other.join()
        self.assertEqual((len(errors), len(read)), (2, 4))
        self.assertIn("is computing", errors[0])

    def test_reads_wait_for_the_call_and_are_not_starved_between_calls(self):
        alone = run_room(scans=60).trajectory.poses
        # Made before: between the calls nobody gives the GIL away.
        scans = [room_scan(index) for index in range(60)]
        odometry = trajlo.Odometry({"threads": 1})
        done = threading.Event()
        added = [0]
        errors, calls = [], []

        def look():
            while not done.is_set():
                before = added[0]
                try:
                    odometry.trajectory
                except Exception as error:
                    errors.append(error)
                calls.append(added[0] - before)

        others = [threading.Thread(target=look) for _ in range(3)]
        for other in others:
            other.start()
        try:
            for scan in scans:
                odometry.add(scan)
                added[0] += 1
            odometry.finish()
        finally:
            done.set()
            for other in others:
                other.join(60)
        self.assertEqual(errors, [])
        # Those who waited did so for one call, and not until they came between two by chance.
        waited = [count for count in calls if count > 0]
        self.assertGreater(len(waited), 0)
        self.assertLessEqual(np.median(waited), 2)
        np.testing.assert_array_equal(odometry.trajectory.poses, alone)

    def test_two_odometries_whose_callbacks_read_each_other_do_not_wait_for_ever(self):
        both, errors = [None, None], []

        def work(slot):
            try:
                for index in range(20):
                    both[slot].add(room_scan(index))
            except trajlo.StateError as error:
                errors.append(error)

        def callback(slot):
            return lambda window: both[1 - slot].map

        for slot in (0, 1):
            both[slot] = trajlo.Odometry({"threads": 1}, on_window=callback(slot))
        threads = [threading.Thread(target=work, args=(slot,), daemon=True) for slot in (0, 1)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join(60)
        self.assertFalse(any(thread.is_alive() for thread in threads))
        self.assertEqual(errors, [])

    def test_two_at_a_time_do_not_disturb_each_other(self):
        alone = run_room().trajectory.poses
        results = [None, None]

        def work(slot):
            results[slot] = run_room().trajectory.poses

        threads = [threading.Thread(target=work, args=(slot,)) for slot in (0, 1)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for result in results:
            np.testing.assert_array_equal(result, alone)


if __name__ == "__main__":
    unittest.main()
