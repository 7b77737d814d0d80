# SPDX-License-Identifier: MIT
"""Readers as iterators: what they give, and what they say about damage."""
import contextlib
import sqlite3
import threading
import unittest
import warnings

import numpy as np

import trajlo
from support import FolderTest, run_command


class RecordingTest(FolderTest):

    def simulated(self, name="recording", seconds=0.6, *more):
        path = self.folder / name
        run_command("trajlo_simulate", "--scenario=hall_os1_16", f"--output={path}",
                    f"--duration_s={seconds}", *more)
        return path

    def test_a_bag_and_a_folder_have_the_same_scans(self):
        folder = self.simulated()
        bag = self.simulated("bagged", 0.6, "--format=bag") / "recording.bag"
        simulation = trajlo.simulate("hall_os1_16", duration_s=0.6)
        for path in (folder, bag, str(bag), [folder]):
            recording = trajlo.open(path)
            scans = list(recording)
            self.assertEqual(len(scans), 6)
            self.assertEqual(len(recording), 6)
            for scan, expected in zip(scans, simulation):
                np.testing.assert_array_equal(scan.points, expected.points)
                np.testing.assert_array_equal(scan.times_ns, expected.times_ns)
        self.assertIn("scans", recording.description)

    def test_each_iteration_begins_anew(self):
        recording = trajlo.open(self.simulated())
        first, second = iter(recording), iter(recording)
        next(first)
        self.assertEqual(len(list(second)), 6)
        self.assertEqual(len(list(first)), 5)
        self.assertEqual([scan.stamp_ns for scan in recording],
                         [scan.stamp_ns for scan in recording])
        self.assertEqual(recording.report()["scans_read"], 6)

    def test_options_of_the_input(self):
        path = self.simulated()
        first = next(iter(trajlo.open(path)))
        late = list(trajlo.open(path, {"input.start_s": 0.25}))
        self.assertLess(len(late), 6)
        still = next(iter(trajlo.open(path, {"input": {"point_time": "none"}})))
        self.assertTrue(first.has_point_times)
        self.assertFalse(still.has_point_times)
        with self.assertRaisesRegex(trajlo.ConfigError, "did you mean 'input.start_s'"):
            trajlo.open(path, {"input.strat_s": 1})

    def test_what_cannot_be_read(self):
        text = self.folder / "notes.txt"
        text.write_text("no recording")
        broken = self.folder / "broken.bag"
        broken.write_bytes(b"#ROSBAG V2.0\n" + b"\0" * 100)
        for path in (self.folder / "missing.bag", text, broken, self.folder, "", []):
            with self.subTest(path=path), self.assertRaises(trajlo.InputError):
                trajlo.open(path)
        for path in (None, 3, [None]):
            with self.subTest(path=path), self.assertRaises(TypeError):
                trajlo.open(path)

    def test_a_bag_that_is_cut_is_said_to_be(self):
        bag = self.simulated("bagged", 0.6, "--format=bag") / "recording.bag"
        bag.write_bytes(bag.read_bytes()[: bag.stat().st_size // 2])
        recording = trajlo.open(bag)
        with self.assertWarns(trajlo.PartialInputWarning):
            scans = list(recording)
        self.assertTrue(0 < len(scans) < 6)
        self.assertTrue(recording.report()["is_partial"])
        self.assertTrue(recording.report()["warnings"])

    def test_scans_of_another_format_are_counted(self):
        path = self.simulated()
        (path / "timestamps.txt").unlink()
        for scan in sorted((path / "scans").glob("*.pcd"))[-2:]:
            scan.rename(scan.with_suffix(".ply"))
        recording = trajlo.open(path)
        with self.assertWarnsRegex(trajlo.PartialInputWarning, "left out: 2"):
            self.assertEqual(len(list(recording)), 4)
        self.assertEqual(recording.report()["scans_left_out"], 2)

    def test_a_topic_without_a_message_is_named(self):
        bag = self.simulated("bagged", 0.6, "--format=bag") / "recording.bag"
        database = self.folder / "recording.db3"
        run_command("trajlo_convert", bag, database)
        with contextlib.closing(sqlite3.connect(database)) as file, file:
            (_, topic, *others), = file.execute(
                "SELECT * FROM topics WHERE type LIKE '%PointCloud2'").fetchall()
            file.execute(f"INSERT INTO topics VALUES (99, '/silent'{', ?' * len(others)})", others)
        recording = trajlo.open(database, {"input.topics": [topic, "/silent"],
                                           "sensor.T_body_lidar": [{}, {}]})
        with self.assertWarnsRegex(trajlo.PartialInputWarning, "no message of /silent"):
            self.assertEqual(len(list(recording)), 6)
        self.assertEqual(recording.report()["topics_without_messages"], ["/silent"])

    def test_warnings_can_be_errors(self):
        bag = self.simulated("bagged", 0.6, "--format=bag") / "recording.bag"
        bag.write_bytes(bag.read_bytes()[: bag.stat().st_size // 2])
        with warnings.catch_warnings():
            warnings.simplefilter("error", trajlo.PartialInputWarning)
            warnings.simplefilter("ignore", category=UserWarning, append=True)
            with self.assertRaises((trajlo.PartialInputWarning, trajlo.TrajloWarning)):
                list(trajlo.open(bag))

    def test_threads_that_share_an_iterator_get_scans_or_an_error(self):
        stream = iter(trajlo.simulate("hall_os1_16", duration_s=1.0))
        scans, errors = [], []

        def read():
            while True:
                try:
                    scans.append(next(stream).stamp_ns)
                except StopIteration:
                    return
                except trajlo.StateError as error:
                    errors.append(error)

        threads = [threading.Thread(target=read) for _ in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(set(scans)), 10)
        self.assertEqual(len(scans), 10)


class SimulationTest(unittest.TestCase):

    def test_each_iteration_gives_the_same(self):
        simulation = trajlo.simulate("hall_os1_16", seed=5, duration_s=0.5, threads=1)
        again = trajlo.simulate("hall_os1_16", seed=5, duration_s=0.5, threads=2)
        other = trajlo.simulate("hall_os1_16", seed=6, duration_s=0.5)
        self.assertEqual(len(simulation), 5)
        first = [scan.points.copy() for scan in simulation]
        for scans in (simulation, again):
            for a, b in zip(first, scans):
                np.testing.assert_array_equal(a, b.points)
        self.assertFalse(np.array_equal(first[0], next(iter(other)).points))

    def test_points_lie_on_the_same_walls_from_every_true_pose(self):
        simulation = trajlo.simulate("hall_os1_16", duration_s=4.0, parameters={
            "lidar.range_sigma_m": 0, "motion.rest_s": 0.5})
        scans = list(simulation)
        lowest = []
        for scan in (scans[0], scans[-1]):
            T = simulation.truth.at(times_ns=scan.times_ns) @ simulation.T_body_lidar[scan.lidar]
            world = (T @ np.c_[scan.points, np.ones(len(scan))][:, :, None])[:, :3, 0]
            lowest.append(np.percentile(world[:, 2], 1))
        moved = np.linalg.norm(np.diff(simulation.truth.positions[[0, -1]], axis=0))
        self.assertGreater(moved, 0.2)
        self.assertAlmostEqual(lowest[0], lowest[1], delta=0.01)  # The floor.

    def test_parameters(self):
        simulation = trajlo.simulate("hall_os1_16", seed=2, duration_s=1.0, parameters={
            "moving_objects": True, "lidar.range_sigma_m": 0.05,
            "lidar0.T_body_lidar": [0, 0, 0.5, 0, 0, 0, 1]})
        values = simulation.parameters
        self.assertEqual(values["seed"], "2")
        self.assertEqual(values["moving_objects"], "true")
        self.assertEqual(values["lidar0.range_sigma_m"], "0.05")
        self.assertEqual(simulation.T_body_lidar[0][2, 3], 0.5)
        self.assertIn("hall_os1_16", trajlo.scenarios())

    def test_what_cannot_be_simulated(self):
        for message, arguments in [
                ("there is no scenario 'hal_os1_16'; did you mean 'hall_os1_16'?",
                 dict(scenario="hal_os1_16")),
                ("did you mean 'hall_os1_16'?", dict(scenario="hal_os1")),
                ("motion.speed_mps", dict(parameters={"motion.sped_mps": 1})),
                ("not a number", dict(parameters={"motion.speed_mps": "fast"})),
                ("duration_s", dict(duration_s=-1.0)), ("duration_s", dict(duration_s=1e300)),
                ("duration_s", dict(duration_s=float("nan"))), ("seed", dict(seed=-1)),
                ("", dict(parameters={"motion.kind": "replay", "motion.replay_file": "none"}))]:
            with self.subTest(arguments), self.assertRaisesRegex(trajlo.ConfigError, message):
                trajlo.simulate(**{"scenario": "hall_os1_16", **arguments})
        for arguments in (dict(scenario=3), dict(seed=1.5), dict(duration_s="long")):
            with self.subTest(arguments), self.assertRaises(TypeError):
                trajlo.simulate(**{"scenario": "hall_os1_16", **arguments})


if __name__ == "__main__":
    unittest.main()
