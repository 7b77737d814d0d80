# SPDX-License-Identifier: MIT
"""Faults of a campaign: recordings of all kinds hold the same, faults do what they say, and which of
them a run has follows from its seed and number."""
import pathlib
import struct
import unittest

import numpy as np
from bag_writer import write_bag
from support import FolderTest

from trajlo_campaign import (draw, file_faults, message_file, point_faults, prepare, scan_folder,
                             scenes, simulator_faults, stamp_faults)

SCANS, POINTS = 60, 50
START_NS = prepare.START_NS
PCD_HEAD = ("# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z intensity time\n"
            "SIZE 4 4 4 4 4\nTYPE F F F F F\nCOUNT 1 1 1 1 1\nWIDTH {0}\nHEIGHT 1\n"
            "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS {0}\nDATA binary\n")
DTYPE = np.dtype([(name, "<f4") for name in ("x", "y", "z", "intensity", "time")])


def scan_points(index):
    rng = np.random.default_rng(index)
    points = np.zeros(POINTS, DTYPE)
    for axis in "xyz":
        points[axis] = rng.uniform(-9.0, 9.0, POINTS)
    points["time"] = np.linspace(0.0, 0.0999, POINTS)
    return points


def point_cloud2(index):
    """A message as a driver writes it."""
    def text(value):
        return struct.pack("<I", len(value)) + value.encode()
    stamp = struct.pack("<II", *divmod(START_NS + index * 100_000_000, 10**9))
    fields = b"".join(text(name) + struct.pack("<IBI", 4 * place, 7, 1)
                      for place, name in enumerate(DTYPE.names))
    data = scan_points(index).tobytes()
    return (struct.pack("<I", index) + stamp + text("lidar") + struct.pack("<III", 1, POINTS, 5)
            + fields + struct.pack("<BII", 0, 20, 20 * POINTS)
            + struct.pack("<I", len(data)) + data + b"\1")


class RecordingTest(FolderTest):
    """Little recordings of each kind."""

    def make_folder(self, name="scans_folder"):
        folder = self.folder / name
        (folder / "scans").mkdir(parents=True)
        for index in range(SCANS):
            (folder / "scans" / f"{index:06d}.pcd").write_bytes(
                PCD_HEAD.format(POINTS).encode() + scan_points(index).tobytes())
        stamps = (scan_folder.seconds(START_NS + index * 100_000_000) for index in range(SCANS))
        (folder / "timestamps.txt").write_text("".join(f"{stamp}\n" for stamp in stamps))
        return scan_folder.ScanFolder(folder)

    def make_bag(self):
        path = self.folder / "recording.bag"
        write_bag(path, [("/points", "sensor_msgs/PointCloud2",
                          START_NS + (index + 1) * 100_000_000, point_cloud2(index))
                         for index in range(SCANS)])
        return path


class RecordingsTest(RecordingTest):
    def test_formats_hold_the_same_scans(self):
        bag = self.make_bag()
        message_file.bag_to_mcap(bag, self.folder / "recording.mcap")
        for recording in (self.make_folder(), *message_file.open_messages(bag),
                          *message_file.open_messages(self.folder / "recording.mcap")):
            self.assertEqual(len(recording), SCANS)
            for index in (0, SCANS - 1):
                self.assertEqual(recording.stamp(index), START_NS + index * 100_000_000)
                points = recording.points(index)
                for name in DTYPE.names:
                    np.testing.assert_array_equal(points[name], scan_points(index)[name])

    def test_what_is_edited_is_what_is_read_again(self):
        bag = self.make_bag()
        message_file.bag_to_mcap(bag, self.folder / "recording.mcap")

        def up(points):
            points["z"] += 1.0
            return points
        for again, recording in (
                (lambda: scan_folder.ScanFolder(self.folder / "scans_folder"), self.make_folder()),
                *((lambda path=path: message_file.open_messages(path)[0],
                   message_file.open_messages(path)[0])
                  for path in (bag, self.folder / "recording.mcap"))):
            recording.shift([3], 1_500_000_001)
            recording.edit(5, up)
            recording.save()
            read = again()
            self.assertEqual(read.stamp(3), START_NS + 300_000_000 + 1_500_000_001)
            self.assertEqual(read.stamp(4), START_NS + 400_000_000)
            np.testing.assert_array_equal(read.points(5)["z"], scan_points(5)["z"] + np.float32(1))
            np.testing.assert_array_equal(read.points(6)["z"], scan_points(6)["z"])

    def test_a_copy_is_damaged_alone(self):
        base = self.make_folder()
        scenes.copy(self.folder / "scans_folder", self.folder / "copy")
        copied = scan_folder.ScanFolder(self.folder / "copy")
        for function in file_faults.FOLDER_FAULTS[:8]:
            function(copied, np.random.default_rng(1))
        copied.save()
        for index in range(SCANS):
            np.testing.assert_array_equal(base.points(index), scan_points(index))
        self.assertEqual(len(base.stamps_file.read_text().splitlines()), SCANS)


class FaultsTest(RecordingTest):
    def contents(self, folder):
        return {path.relative_to(folder): path.read_bytes()
                for path in sorted(pathlib.Path(folder).rglob("*")) if path.is_file()}

    def test_each_fault_of_a_folder_changes_it_and_again_in_the_same_way(self):
        self.make_folder()
        original = self.contents(self.folder / "scans_folder")
        functions = set(stamp_faults.FAULTS) | set(point_faults.FAULTS) | \
            set(file_faults.FOLDER_FAULTS)
        for function in functions:
            found = []
            for name in ("first", "second"):
                copy = self.folder / f"{function.__name__}_{name}"
                scenes.copy(self.folder / "scans_folder", copy)
                recording = scan_folder.ScanFolder(copy)
                said = function(recording, np.random.default_rng((7, 2)))
                recording.save()
                found.append((said, self.contents(copy)))
            with self.subTest(function.__name__):
                self.assertTrue(found[0][0])
                self.assertNotEqual(found[0][1], original)
                self.assertEqual(found[0], found[1])

    def test_each_fault_of_a_bag_changes_it(self):
        original = self.make_bag().read_bytes()
        for function in set(stamp_faults.FAULTS) | set(point_faults.FAULTS):
            path = self.folder / f"{function.__name__}.bag"
            path.write_bytes(original)
            recording = message_file.open_messages(path)[0]
            function(recording, np.random.default_rng((7, 2)))
            recording.save()
            with self.subTest(function.__name__):
                self.assertNotEqual(path.read_bytes(), original)
                self.assertEqual(len(path.read_bytes()), len(original))
        for function in set(file_faults.BYTE_FAULTS):
            path = self.folder / f"{function.__name__}.bag"
            path.write_bytes(original)
            function(path, np.random.default_rng((7, 2)))
            with self.subTest(function.__name__):
                self.assertNotEqual(path.read_bytes(), original)

    def test_all_faults_together_can_be_applied_in_their_order(self):
        for seed in range(5):
            recording = self.make_folder(f"folder{seed}")
            for family in ("stamps", "points", "folder"):
                for index, function in enumerate(draw.FAMILIES[family][0]):
                    function(recording, np.random.default_rng((seed, index)))
            recording.save()

    def test_the_simulator_knows_the_parameters(self):
        for scene in scenes.SCENES:
            for function in simulator_faults.FAULTS:
                parameters = function(scene, np.random.default_rng(3))
                for key in parameters:
                    self.assertRegex(key, r"^(faults\.[a-z_]+|lidar\d?\.[a-z_]+)$")

    def test_a_silent_lidar_speaks_again(self):
        for scene in scenes.SCENES:
            for seed in range(100):
                silent = simulator_faults.silence(scene, np.random.default_rng(seed))
                self.assertLess(silent["faults.silent_from_s"], silent["faults.silent_until_s"])
                self.assertLess(silent["faults.silent_until_s"], scene.duration_s - 0.2)


class DrawTest(unittest.TestCase):
    def test_a_number_is_always_the_same_run(self):
        for number in (0, 17, 999):
            self.assertEqual(draw.draw(1, number), draw.draw(1, number))
        self.assertNotEqual([draw.draw(1, number) for number in range(20)],
                            [draw.draw(2, number) for number in range(20)])

    def test_runs_have_one_to_four_faults_that_their_format_can_have(self):
        runs = [draw.draw(1, number) for number in range(1000)]
        for run in runs:
            self.assertTrue(1 <= len(run.faults) <= draw.MOST_FAULTS)
            for fault in run.faults:
                self.assertIn(run.kind, draw.FAMILIES[fault.family][1])
                self.assertLess(fault.lidar, run.scene.lidars)
            names = [fault.name for fault in run.faults]
            self.assertEqual(len(names), len(set(names)))

    def test_a_thousand_runs_meet_every_scene_format_and_fault(self):
        runs = [draw.draw(1, number) for number in range(1000)]
        self.assertEqual({run.scene.name for run in runs}, {scene.name for scene in scenes.SCENES})
        self.assertEqual({run.kind for run in runs}, set(scenes.FORMATS))
        self.assertEqual({fault.function for run in runs for fault in run.faults},
                         {function for functions, _ in draw.FAMILIES.values()
                          for function in functions})


if __name__ == "__main__":
    unittest.main()
