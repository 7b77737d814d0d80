# SPDX-License-Identifier: MIT
"""Poses at any time, against scipy's matrix exponential and logarithm."""
import copy
import pickle
import unittest

import numpy as np
from scipy.linalg import expm, logm
from scipy.spatial.transform import Rotation

import trajlo
from support import FolderTest

BEGIN = 1_700_000_000_000_000_001


def random_poses(count, seed=1):
    random = np.random.default_rng(seed)
    poses = np.tile(np.eye(4), (count, 1, 1))
    poses[:, :3, :3] = Rotation.from_rotvec(random.normal(0, 0.3, (count, 3))).as_matrix()
    poses[:, :3, 3] = random.normal(0, 2, (count, 3))
    return poses


class TrajectoryTest(FolderTest):

    def setUp(self):
        super().setUp()
        self.times_ns = BEGIN + np.arange(10) * 30_000_000
        self.poses = random_poses(10)
        self.trajectory = trajlo.Trajectory(self.times_ns, self.poses)

    def test_gives_back_what_it_is_made_of(self):
        t = self.trajectory
        self.assertEqual(len(t), 10)
        np.testing.assert_array_equal(t.times_ns, self.times_ns)
        np.testing.assert_allclose(t.times, 1e-9 * self.times_ns, rtol=0, atol=3e-7)
        np.testing.assert_allclose(t.poses, self.poses, atol=1e-14)
        np.testing.assert_array_equal(t.positions, self.poses[:, :3, 3])
        np.testing.assert_allclose(Rotation.from_quat(t.quaternions).as_matrix(),
                                   self.poses[:, :3, :3], atol=1e-14)
        self.assertIsNone(t.flags)

    def test_between_poses_the_twist_is_constant(self):
        for i, share in [(0, 0.25), (4, 0.5), (8, 0.9)]:
            t_ns = int(self.times_ns[i]) + round(share * 30_000_000)
            step = logm(np.linalg.inv(self.poses[i]) @ self.poses[i + 1])
            expected = self.poses[i] @ expm(share * step)
            np.testing.assert_allclose(self.trajectory.at(times_ns=t_ns), np.real(expected),
                                       atol=1e-12)

    def test_shapes_follow_the_times(self):
        t = self.trajectory
        self.assertEqual(t.at(times_ns=BEGIN).shape, (4, 4))
        self.assertEqual(t.at(t.times[3]).shape, (4, 4))
        self.assertEqual(t.at(times_ns=[BEGIN]).shape, (1, 4, 4))
        self.assertEqual(t.at([]).shape, (0, 4, 4))
        # Rounded seconds at the two ends are within the trajectory.
        np.testing.assert_allclose(t.at(t.times), self.poses, atol=1e-4)
        np.testing.assert_allclose(t.at(times_ns=t.times_ns), self.poses, atol=1e-14)

    def test_samples_make_a_trajectory(self):
        sampled = self.trajectory.sample(times_ns=self.times_ns[2:5] + 10)
        np.testing.assert_array_equal(sampled.times_ns, self.times_ns[2:5] + 10)
        np.testing.assert_allclose(sampled.poses,
                                   self.trajectory.at(times_ns=self.times_ns[2:5] + 10), atol=1e-14)

    def test_times_outside_are_said_or_nan(self):
        late = int(self.times_ns[-1]) + 2000
        for times in (dict(times_ns=late), dict(times_ns=BEGIN - 1), dict(times_s=0.0),
                      dict(times_ns=[BEGIN, late])):
            with self.assertRaisesRegex(trajlo.InputError, "does not cover .* it goes from"):
                self.trajectory.at(**times)
        some = self.trajectory.at(times_ns=[BEGIN, late], outside="nan")
        np.testing.assert_allclose(some[0], self.poses[0], atol=1e-14)
        self.assertTrue(np.isnan(some[1, :3]).all())
        with self.assertRaises(trajlo.InputError):
            trajlo.Trajectory(np.empty(0, np.int64), np.empty((0, 4, 4))).at(0.0)

    def test_times_that_float32_cannot_hold_are_refused(self):
        t = self.trajectory
        for times in (np.float32(t.times[3]), t.times.astype(np.float32),
                      t.times.astype(">f4"), list(t.times.astype(np.float32)), np.float32(17.0),
                      np.float16(0.1)):
            for call in (t.at, t.sample):
                with self.assertRaisesRegex(trajlo.InputError,
                                            "times_s: must be float64 or times_ns, found float"):
                    call(times)
        # Near zero it is fine enough.
        early = trajlo.Trajectory(self.times_ns - BEGIN, self.poses)
        np.testing.assert_allclose(early.at(np.float32(0.15)), early.at(0.15), atol=1e-5)

    def test_pickles_and_copies_are_the_same_to_the_last_bit(self):
        sampled = self.trajectory.sample(times_ns=self.times_ns[:-1] + 7_654_321)
        for again in (pickle.loads(pickle.dumps(sampled)), copy.copy(sampled),
                      copy.deepcopy(sampled)):
            np.testing.assert_array_equal(again.times_ns, sampled.times_ns)
            np.testing.assert_array_equal(again.quaternions, sampled.quaternions)
            np.testing.assert_array_equal(again.positions, sampled.positions)
            self.assertIsNone(again.flags)
        with self.assertRaisesRegex(trajlo.InputError, "no pickle of a trajectory"):
            trajlo.Trajectory.__new__(trajlo.Trajectory).__setstate__((1, 2))

    def test_flags_of_a_file_are_those_beside_it_if_they_are_of_its_poses(self):
        path, flags = self.folder / "trajectory.tum", self.folder / "flags.csv"
        self.trajectory.save_tum(path)
        self.assertIsNone(trajlo.read_trajectory(path).flags)
        lines = [f"{t_ns // 10**9}.{t_ns % 10**9:09d},{k},name" for k, t_ns in
                 enumerate(self.times_ns.tolist())]
        head = "t_s,flags,flag_names"
        flags.write_text("\n".join([head] + lines) + "\n")
        read = trajlo.read_trajectory(str(path))
        self.assertEqual(read.flags.tolist(), list(range(10)))
        # Those of a time between two poses are those of the later one, as in flags.csv.
        self.assertEqual(read.sample(times_ns=self.times_ns[3:5] + 1).flags.tolist(), [4, 5])
        self.assertEqual(pickle.loads(pickle.dumps(read)).flags.tolist(), list(range(10)))
        for other in ([head] + lines[:-1], lines, [head, "nan,1,", "1e999,2,"], ["\0"],
                      [head] + [lines[0].replace("01,", "02,", 1)] + lines[1:]):
            flags.write_text("\n".join(other) + "\n")
            self.assertIsNone(trajlo.read_trajectory(path).flags, other)

    def test_a_misspelt_argument_comes_with_the_nearest(self):
        for call in (lambda: self.trajectory.at(times_n=BEGIN),
                     lambda: self.trajectory.sample(time_ns=BEGIN)):
            with self.assertRaisesRegex(TypeError, r"\(\) has no argument '.*'; did you mean 'times"):
                call()

    def test_arguments_that_do_not_fit(self):
        t, times, poses = self.trajectory, self.times_ns, self.poses
        scaled, nan, mirrored = poses.copy(), poses.copy(), poses.copy()
        scaled[3, :3, :3] *= 1.1
        nan[5, 0, 3] = np.nan
        mirrored[:, 0, :3] *= -1
        bottom = poses.copy()
        bottom[0, 3, 0] = 1.0
        for message, call in [
                ("increasing|after the one before", lambda: trajlo.Trajectory(times[::-1], poses)),
                ("after the one before", lambda: trajlo.Trajectory(times * 0, poses)),
                (r"times_ns\[9\]: must be within", lambda: trajlo.Trajectory(
                    np.r_[times[:9], 2**62], poses)),
                ("one element for each", lambda: trajlo.Trajectory(times[:5], poses)),
                ("of shape .N, 4, 4", lambda: trajlo.Trajectory(times, poses[:, :3])),
                ("of shape .N, 4, 4", lambda: trajlo.Trajectory(times[:1], poses[0])),
                ("whole numbers", lambda: trajlo.Trajectory(1e-9 * times, poses)),
                (r"poses\[3\].*rotation", lambda: trajlo.Trajectory(times, scaled)),
                (r"poses\[5\].*finite", lambda: trajlo.Trajectory(times, nan)),
                (r"poses\[0\].*rotation", lambda: trajlo.Trajectory(times, mirrored)),
                (r"poses\[0\].*last row", lambda: trajlo.Trajectory(times, bottom)),
                ("times_s: must be seconds", lambda: t.at(float("nan"))),
                ("times_s: must be seconds", lambda: t.at(t.times_ns)),
                ("whole numbers", lambda: t.at(times_ns=t.times)),
                ("of shape", lambda: t.at(np.zeros((2, 2)))),
                ("without a mask", lambda: t.at(np.ma.masked_array(t.times, mask=True))),
                ("without a mask", lambda: t.at(times_ns=np.ma.masked_array(times))),
                ("without a mask", lambda: trajlo.Trajectory(times, np.ma.masked_array(poses))),
                ("after the one before", lambda: t.sample(times_ns=[BEGIN, BEGIN])),
        ]:
            with self.subTest(message), self.assertRaisesRegex(trajlo.InputError, message):
                call()
        for call in (t.at, lambda: t.at(1.0, times_ns=1), lambda: t.at(1.0, outside="zero")):
            with self.assertRaises(trajlo.UsageError):
                call()

    def test_writes_and_reads_tum(self):
        path = self.folder / "Größe.tum"
        self.trajectory.save_tum(path)
        again = trajlo.read_trajectory(path)
        np.testing.assert_array_equal(again.times_ns, self.times_ns)
        np.testing.assert_allclose(again.poses, self.poses, atol=2e-9)
        with self.assertRaisesRegex(trajlo.OutputError, "or pass overwrite=True to replace it"):
            self.trajectory.save_tum(path)
        self.trajectory.save_tum(path, overwrite=True)
        with self.assertRaises(trajlo.OutputError):
            self.trajectory.save_tum(self.folder / "missing" / "a.tum")
        with self.assertRaises(trajlo.OutputError):
            self.trajectory.save_tum("/dev/full")

    def test_files_that_cannot_be_read(self):
        bad = self.folder / "bad.tum"
        bad.write_text("0.0 1 2 3 0 0 0 1\nnonsense\n")
        with self.assertRaisesRegex(trajlo.InputError, "bad.tum.*2"):
            trajlo.read_trajectory(bad)
        with self.assertRaises(trajlo.InputError):
            trajlo.read_trajectory(self.folder / "missing.tum")
        kitti = self.folder / "poses.txt"
        kitti.write_text("1 0 0 0 0 1 0 0 0 0 1 0\n" * 3)
        with self.assertRaisesRegex(trajlo.InputError, "no stamps"):
            trajlo.read_trajectory(kitti)
        times = self.folder / "times.txt"
        times.write_text("0.0\n0.1\n0.2\n")
        self.assertEqual(len(trajlo.read_trajectory(kitti, times=times)), 3)
        times.write_text("0.0\n0.1\n")
        with self.assertRaisesRegex(trajlo.InputError, "2 stamps"):
            trajlo.read_trajectory(kitti, times=times)
        with self.assertRaisesRegex(trajlo.UsageError, "format: must be"):
            trajlo.read_trajectory(kitti, format="csv")


if __name__ == "__main__":
    unittest.main()
