# SPDX-License-Identifier: MIT
"""Arrays in, views out; what does not fit is refused with its name, and never a crash."""
import copy
import gc
import pickle
import unittest
import warnings

import numpy as np

import trajlo
from support import room_points

STAMP = 1_700_000_000_123_456_789


class ScanTest(unittest.TestCase):

    def test_keeps_what_it_is_given(self):
        points = room_points(100).astype(np.float32)
        times_ns = STAMP + np.arange(100) * 1000
        scan = trajlo.Scan(points, times_ns=times_ns, stamp_ns=STAMP, lidar=2,
                           intensities=np.arange(100, dtype=np.uint16))
        np.testing.assert_array_equal(scan.points, points)
        np.testing.assert_array_equal(scan.times_ns, times_ns)
        np.testing.assert_array_equal(scan.intensities, np.arange(100))
        self.assertEqual((len(scan), scan.stamp_ns, scan.lidar), (100, STAMP, 2))
        self.assertTrue(scan.has_point_times)
        self.assertIsNone(scan.recorded_ns)

    def test_times_after_the_stamp_are_exact_to_the_nanosecond(self):
        offsets_ns = np.arange(0, 100_000_000, 7_654_321)
        points = room_points(len(offsets_ns))
        scan = trajlo.Scan(points, 1e-9 * offsets_ns, stamp_ns=STAMP)
        np.testing.assert_array_equal(scan.times_ns, STAMP + offsets_ns)
        again = trajlo.Scan(points, scan.times_s, stamp_ns=STAMP)
        np.testing.assert_array_equal(again.times_ns, scan.times_ns)

    def test_any_strides_and_both_widths(self):
        points = room_points(50)
        scan = trajlo.Scan(points, stamp_ns=STAMP)
        record = np.zeros(50, dtype=[("tag", np.uint8), ("xyz", np.float32, 3)])  # Not aligned.
        record["xyz"] = points
        for same in (np.asfortranarray(points), points[::-1][::-1], record["xyz"],
                     points.astype(">f8"), np.repeat(points, 2, axis=1)[:, ::2],
                     points.tolist()):
            np.testing.assert_array_equal(trajlo.Scan(same, stamp_ns=STAMP).points, scan.points)
        self.assertFalse(scan.has_point_times)

    def test_a_fourth_column_is_the_intensity(self):
        points = np.column_stack([room_points(50), np.arange(50)])
        for same in (points, points.astype(np.float32), np.asfortranarray(points)):
            scan = trajlo.Scan(same, stamp_ns=STAMP)
            np.testing.assert_array_equal(scan.points, points[:, :3].astype(np.float32))
            np.testing.assert_array_equal(scan.intensities, np.arange(50))

    def test_views_are_no_copies_and_outlive_their_scan(self):
        scan = trajlo.Scan(room_points(1000), stamp_ns=STAMP)
        first, second = scan.points, scan.points
        self.assertTrue(np.shares_memory(first, second))
        expected = first.copy()
        del scan, second
        gc.collect()
        np.testing.assert_array_equal(first, expected)

    def test_views_cannot_be_written(self):
        scan = trajlo.Scan(room_points(10), stamp_ns=STAMP)
        for view in (scan.points, scan.times_ns, scan.intensities):
            with self.assertRaises(ValueError):
                view[0] = 1
            with self.assertRaises(ValueError):
                view.flags.writeable = True

    def test_an_empty_scan_is_one(self):
        scan = trajlo.Scan(np.empty((0, 3)), np.empty(0), stamp_ns=STAMP)
        self.assertEqual(scan.points.shape, (0, 3))
        self.assertEqual(scan.times_ns.shape, (0,))

    def test_a_return_that_is_missing_needs_no_time(self):
        points = np.array([[1.0, 2.0, 3.0], [np.nan, np.nan, np.nan]])
        scan = trajlo.Scan(points, np.array([0.01, np.nan]), stamp_ns=STAMP)
        np.testing.assert_array_equal(scan.times_ns, [STAMP + 10_000_000, STAMP])

    def test_what_does_not_fit_is_refused_by_name(self):
        points = room_points(4)
        nan_time = np.array([0.0, 0.1, np.nan, 0.2])
        cases = [
            ("points: must be of shape .*found the shape .3, 5", dict(points=np.zeros((3, 5)))),
            ("points: must be of shape", dict(points=points[0])),
            ("points: must be of shape", dict(points=np.empty(0))),
            ("points: must be of shape", dict(points=np.empty((4, 2)))),
            ("points: must be float32 or float64, found an array of int16: whole numbers are "
             "mostly millimetres",
             dict(points=np.zeros((4, 3), np.int16))),
            ("points: must be float32 or float64", dict(points=points.astype(complex))),
            ("points: must be float32 or float64", dict(points=points > 0)),
            ("points: must be", dict(points="points")),
            ("points: must be", dict(points=None)),
            ("points: must be", dict(points=np.array([[1, 2, None]], dtype=object))),
            ("times_s: must have one element for each of the 4 points, found 3",
             dict(times_s=np.zeros(3))),
            ("times_s: must be of shape", dict(times_s=np.zeros((4, 1)))),
            (r"times_s\[2\]: must be seconds", dict(times_s=nan_time)),
            (r"times_s\[0\].*absolute times are times_ns", dict(times_s=np.full(4, 1.7e9))),
            (r"times_s\[0\]", dict(times_s=np.full(4, np.inf))),
            (r"times_s\[0\].*absolute times are times_ns",
             dict(times_s=np.full(4, 1.7e9, np.float32))),
            ("times_s: must be float64 or times_ns, found float32: near 50 s its neighbours are "
             "3.8147e-06 s apart", dict(times_s=np.full(4, 50.0, np.float32))),
            ("points: must be an array without a mask, found a masked array",
             dict(points=np.ma.masked_array(points, mask=True))),
            ("times_s: must be an array without a mask",
             dict(times_s=np.ma.masked_array(np.zeros(4), mask=[1, 0, 0, 0]))),
            ("times_ns: must be an array without a mask",
             dict(times_ns=np.ma.masked_array(np.zeros(4, np.int64)))),
            ("intensities: must be an array without a mask",
             dict(intensities=np.ma.masked_array(np.zeros(4)))),
            ("times_s: must be numbers", dict(times_s=np.array(["a"] * 4))),
            ("times_ns: must be whole numbers", dict(times_ns=np.zeros(4))),
            ("times_ns: must have one element", dict(times_ns=np.zeros(5, np.int64))),
            ("times_ns: must be within int64", dict(times_ns=np.full(4, 2**64 - 1, np.uint64))),
            ("not both", dict(times_s=np.zeros(4), times_ns=np.zeros(4, np.int64))),
            ("intensities: must have one element", dict(intensities=np.zeros(1))),
            ("lidar: must be a number from 0", dict(lidar=-1)),
            ("lidar: must be a number from 0", dict(lidar=10**12)),
            ("stamp_ns: must be within", dict(stamp_ns=2**62 + 1)),
            ("stamp_ns: must be within", dict(stamp_ns=2**70)),
            ("points: have intensities", dict(points=np.zeros((4, 4)), intensities=np.zeros(4))),
        ]
        for message, wrong in cases:
            with self.subTest(message):
                with self.assertRaisesRegex(trajlo.InputError, message):
                    trajlo.Scan(**{"points": points, "stamp_ns": STAMP, **wrong})

    def test_pickles_and_copies_are_the_same(self):
        points = room_points(100)
        points[3] = np.nan
        for arguments in (dict(), dict(times_s=np.linspace(0, 0.1, 100), lidar=2,
                                       intensities=np.arange(100))):
            scan = trajlo.Scan(points, stamp_ns=STAMP, **arguments)
            for again in (pickle.loads(pickle.dumps(scan)), copy.deepcopy(scan)):
                for name in ("points", "times_ns", "intensities"):
                    np.testing.assert_array_equal(getattr(again, name), getattr(scan, name))
                for name in ("stamp_ns", "recorded_ns", "has_point_times", "lidar"):
                    self.assertEqual(getattr(again, name), getattr(scan, name))

    def test_a_misspelt_argument_comes_with_the_nearest(self):
        with self.assertRaisesRegex(TypeError, "no argument 'stamp'; did you mean 'stamp_ns'"):
            trajlo.Scan(room_points(4), stamp=1)

    def test_any_arrays_make_a_scan_or_an_error(self):
        random = np.random.default_rng(1)
        types = ["f4", "f8", ">f4", "f2", "i2", "i8", "u1", "u8", "?", "c16", "U3", "O", "M8[ns]"]
        extremes = [0, -1, 2**63 - 1, -2**63, 1e300, -1e300, np.nan, np.inf]

        def array():
            if random.uniform() < 0.1:
                return [None, "points", 3, -1.5, [], [[1, 2, 3]], {}, b"", True][random.integers(9)]
            shape = [(4, 3), (4,), (0, 3), (0,), (3, 4), (), (4, 3, 1), (5, 3)][random.integers(8)]
            made = np.zeros(shape, dtype="f8")
            if made.size and random.uniform() < 0.5:
                made.flat[random.integers(made.size)] = random.choice(extremes)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                try:
                    return made.astype(random.choice(types))[::random.choice([1, -1, 2])]
                except (ValueError, IndexError):
                    return made

        odometry = trajlo.Odometry({"threads": 1})
        made = 0
        for _ in range(3000):
            arguments = {name: array() for name in ("times_s", "times_ns", "intensities")
                         if random.uniform() < 0.4}
            points = array() if random.uniform() < 0.7 else np.zeros((4, 3))
            try:
                stamp_ns = int(random.integers(-2**62, 2**62))
                scan = trajlo.Scan(points, stamp_ns=stamp_ns, **arguments)
            except (trajlo.InputError, TypeError):
                continue
            made += 1
            self.assertEqual(scan.times_s.shape, (len(scan),))
            odometry.add(scan)
        self.assertGreater(made, 100)

    def test_stamps_are_whole_nanoseconds(self):
        for stamp in (1.5, 1.6e18, np.float64(1.6e18), np.float32(5), "now", None):
            with self.assertRaisesRegex(TypeError, "stamp_ns: must be a whole number of nanosec"):
                trajlo.Scan(room_points(4), stamp_ns=stamp)
        with self.assertRaisesRegex(TypeError, r"found 1.6e\+18; a float is exact to 256 ns"):
            trajlo.Scan(room_points(4), stamp_ns=1.6e18)
        self.assertEqual(trajlo.Scan(room_points(4), stamp_ns=np.int64(5)).stamp_ns, 5)


if __name__ == "__main__":
    unittest.main()
