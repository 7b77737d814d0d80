# SPDX-License-Identifier: MIT
"""What the package computes is what the commands compute, to the last byte."""
import csv
import pathlib
import tempfile
import unittest

import numpy as np

import trajlo
from support import FolderTest, run_command

SECONDS = 2.5


def ply_points(path):
    header, _, data = path.read_bytes().partition(b"end_header\n")
    count = int(header.split(b"element vertex ")[1].split()[0])
    return np.frombuffer(data, "<f4").reshape(count, 3)


class SameBytesTest(FolderTest):
    """A flight through the hall."""

    scenario = "hall_os1_16"

    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory(prefix="trajlo_python_")
        cls.addClassCleanup(holder.cleanup)
        cls.recording = pathlib.Path(holder.name) / "recording"
        cls.result = pathlib.Path(holder.name) / "result"
        run_command("trajlo_simulate", f"--scenario={cls.scenario}", f"--output={cls.recording}",
                    f"--duration_s={SECONDS}", "--seed=3")
        run_command("trajlo_run", f"--input={cls.recording}", f"--output={cls.result}", "--quiet",
                    f"--config={cls.recording / 'rig.yaml'}", "--covariance", "--threads=2")
        cls.simulation = trajlo.simulate(cls.scenario, seed=3, duration_s=SECONDS)

    def assert_same_trajectory(self, odometry):
        self.assertEqual(self.tum_of(odometry.trajectory).decode(),
                         (self.result / "trajectory.tum").read_text())

    def run_recording(self, options=None, **more):
        rig = self.recording / "rig.yaml"
        odometry = trajlo.Odometry(options, config=rig, **more)
        for scan in trajlo.open(self.recording, options, config=rig):
            odometry.add(scan)
        odometry.finish()
        return odometry

    def test_the_trajectory_for_any_number_of_threads(self):
        for threads in (1, 2, 3):
            with self.subTest(threads=threads):
                self.assert_same_trajectory(self.run_recording({"threads": threads}))

    def test_arrays_of_the_scans(self):
        odometry = trajlo.Odometry(config=self.recording / "rig.yaml")
        for scan in trajlo.open(self.recording):
            odometry.add(scan.points.astype(float), scan.times_s, stamp_ns=scan.stamp_ns,
                         lidar=scan.lidar)
        odometry.finish()
        self.assert_same_trajectory(odometry)

    def test_the_simulation_without_files(self):
        odometry = trajlo.Odometry(self.simulation.options)
        for scan in self.simulation:
            odometry.add(scan)
        odometry.finish()
        self.assert_same_trajectory(odometry)

    def test_windows_map_and_covariances(self):
        odometry = self.run_recording(covariance=True)
        with open(self.result / "windows.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        windows = odometry.windows
        self.assertEqual([name for name in windows if not name.endswith("_ns")], list(rows[0]))
        for name in rows[0]:
            expected = [row[name] for row in rows]
            if name.endswith("_ms"):
                continue
            found = windows[name]
            if name in ("begin_s", "end_s"):
                exact = [int(text.replace(".", "")) for text in expected]
                self.assertEqual(windows[name[:-1] + "ns"].tolist(), exact)
                np.testing.assert_allclose(found, np.array(expected, float), atol=5e-7, rtol=0)
            elif found.dtype.kind == "U":
                self.assertEqual(found.tolist(), expected)
            else:
                np.testing.assert_array_equal(found, np.array(expected, dtype=found.dtype), name)
        np.testing.assert_array_equal(odometry.map.astype(np.float32),
                                      ply_points(self.result / "map.ply"))
        read = trajlo.read_trajectory(self.result / "trajectory.tum")
        self.assertEqual(read.flags.tolist(), odometry.trajectory.flags.tolist())
        written = np.loadtxt(self.result / "covariance.csv", delimiter=",", skiprows=1)
        upper = np.triu_indices(6)
        np.testing.assert_allclose(odometry.covariances[:, upper[0], upper[1]], written[:, 1:],
                                   rtol=1e-5, atol=1e-15)

    def test_the_truth(self):
        truth = self.folder / "truth.tum"
        self.simulation.truth.save_tum(truth)
        ours, theirs = (np.loadtxt(path) for path in (truth, self.recording / "truth.tum"))
        np.testing.assert_allclose(ours, theirs, atol=1e-9)


class TwoLidarsTest(SameBytesTest):
    """A flight with two LiDARs, which the folder has in two streams."""

    scenario = "hall_os1_16x2"

    def test_too_many_places_are_refused(self):
        with self.assertRaisesRegex(trajlo.UsageError, "one LiDAR is read"):
            trajlo.open(self.recording / "lidar0", self.simulation.options)


class GaussNewtonTest(FolderTest):

    def test_the_other_solver(self):
        recording, result = self.folder / "recording", self.folder / "result"
        run_command("trajlo_simulate", "--scenario=hall_os1_16", f"--output={recording}",
                    "--duration_s=1.5")
        run_command("trajlo_run", f"--input={recording}", f"--output={result}", "--quiet",
                    "--solver=gauss_newton", "--set=window.segments=3")
        odometry = trajlo.Odometry({"solver.kind": "gauss_newton", "window": {"segments": 3}})
        for scan in trajlo.simulate("hall_os1_16", duration_s=1.5):
            odometry.add(scan)
        odometry.finish()
        self.assertEqual(self.tum_of(odometry.trajectory),
                         (result / "trajectory.tum").read_bytes())


if __name__ == "__main__":
    unittest.main()
