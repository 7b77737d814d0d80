# SPDX-License-Identifier: MIT
"""The preparation of data sets, on folders that only look like downloads."""
import json
import os
import pathlib
import re
import stat
import subprocess
import sys
import tempfile
import unittest

import lookalikes
import numpy as np
import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPTS = ROOT / "scripts" / "datasets"

# Says of every bag what lies beside it in a file; writes one pose in place of converting.
PRETENDED_INFO = """#!/bin/sh
for last in "$@"; do :; done
cat "$last.json"
"""
PRETENDED_CONVERT = """#!/bin/sh
echo "0 0 0 0 0 0 0 1" > "$2"
"""


class DatasetsTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.downloads = self.folder / "downloads"
        self.data = self.folder / "data"
        self.downloads.mkdir()
        for name, text in (("trajlo_info", PRETENDED_INFO), ("trajlo_convert", PRETENDED_CONVERT)):
            program = self.folder / "build" / "apps" / name
            program.parent.mkdir(parents=True, exist_ok=True)
            program.write_text(text, encoding="utf-8")
            program.chmod(program.stat().st_mode | stat.S_IXUSR)

    def call(self, name, *arguments):
        process = subprocess.run(
            [sys.executable, "-B", str(SCRIPTS / name), *map(str, arguments),
             f"--build={self.folder / 'build'}"],
            capture_output=True, text=True, check=False)
        return process.returncode, process.stdout + process.stderr

    def write(self, name, text="something"):
        path = self.downloads / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def write_bag(self, name, topics, damaged=False):
        self.write(name)
        topics = [{"name": topic, "type": kind, "messages": 3} for topic, kind in topics]
        self.write(name + ".json", json.dumps(
            {"recordings": [{"topics": topics, "damaged": damaged, "warnings": ["cut"]}]}))

    def test_without_downloads_it_tells_where_they_are_had(self):
        for script in SCRIPTS.iterdir():
            if script.suffix or script.name.startswith("_"):
                continue
            code, text = self.call(script.name)
            self.assertEqual(code, 0, script.name)
            self.assertRegex(text, r"https://")
            self.assertTrue(os.access(script, os.X_OK), script.name)

    def test_kitti_is_linked_as_its_suite_expects(self):
        for part in ("velodyne/000000.bin", "times.txt", "calib.txt"):
            self.write(f"dataset/sequences/03/{part}")
        self.write("dataset/poses/03.txt")
        code, text = self.call("kitti", self.downloads, "--into", self.data)
        self.assertEqual(code, 3, text)  # Ten sequences are missing.
        self.assertTrue((self.data / "kitti/sequences/03/velodyne/000000.bin").is_file())
        self.assertTrue((self.data / "kitti/poses/03.txt").is_symlink())
        self.assertIn("MISSING kitti/sequences/00/velodyne", text)
        self.assertEqual(self.call("kitti", self.downloads, "--into", self.data)[0], 3)

    def test_a_sequence_of_kitti_with_a_scan_too_few_is_unfit(self):
        self.write("dataset/sequences/03/velodyne/000000.bin")
        self.write("dataset/sequences/03/times.txt", "0.0\n0.1\n")
        self.write("dataset/poses/03.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n")
        code, text = self.call("kitti", self.downloads, "--into", self.data)
        self.assertEqual(code, 3, text)
        self.assertIn("has 1 scan, but times.txt beside it has 2 stamps", text)
        self.assertIn("03.txt has 1 pose, but", text)
        self.assertFalse((self.data / "kitti/sequences/03/velodyne").exists())

    def test_the_rig_of_hilti_is_written_from_its_calibration(self):
        self.write("calibration_02.yaml", lookalikes.hilti_calibration())
        self.call("hilti2021", self.downloads, "--into", self.data)
        rig = self.data / "hilti2021" / "rig.yaml"
        ouster, livox = (np.array(lidar["matrix"]) for lidar in
                         yaml.safe_load(rig.read_text())["sensor"]["T_body_lidar"])
        np.testing.assert_allclose(ouster, lookalikes.T_IMU_OUSTER[:3], atol=1e-9)
        np.testing.assert_allclose(livox, lookalikes.transform(*lookalikes.IMU_LIVOX)[:3],
                                   atol=1e-9)
        rig.write_text("mine")
        self.call("hilti2021", self.downloads, "--into", self.data)
        self.assertEqual(rig.read_text(), "mine")

    def test_a_rig_file_of_ones_own_is_taken_in_place_of_the_calibration(self):
        self.write("calibration_02.yaml", lookalikes.hilti_calibration())
        self.write("rig.yaml", "mine")
        self.call("hilti2021", self.downloads, "--into", self.data)
        self.assertEqual((self.data / "hilti2021" / "rig.yaml").read_text(), "mine")
        self.assertEqual((self.downloads / "rig.yaml").read_text(), "mine")

    def test_a_calibration_that_does_not_place_a_lidar_is_unfit(self):
        text = lookalikes.hilti_calibration()
        for old, new, complaint in (("livox_frame", "other", "does not say where livox_frame is"),
                                    ("0.6", "6.0", "are no pose of os_lidar"),
                                    ("sensors", "cameras", "is not the calibration")):
            self.write("calibration_02.yaml", text.replace(old, new))
            code, output = self.call("hilti2021", self.downloads, "--into", self.data)
            self.assertEqual(code, 2, output)
            self.assertIn(complaint, output)
        self.assertFalse((self.data / "hilti2021").exists())

    def test_the_recording_on_the_rope_is_found_by_its_own_name(self):
        for name in ("pendulum.bag", "outdoor_spinning.bag"):
            self.write_bag(name, [("/livox/lidar", "livox_ros_driver/CustomMsg")])
        self.assertEqual(self.call("pointlio", self.downloads, "--into", self.data)[0], 0)
        self.assertEqual((self.data / "pointlio/indoor_swing.bag").resolve().name, "pendulum.bag")

    def test_without_into_nothing_is_written(self):
        self.write("dataset/poses/03.txt")
        self.assertEqual(self.call("kitti", self.downloads)[0], 3)
        self.assertFalse(self.data.exists())

    def test_empty_files_are_not_taken(self):
        self.write("dataset/sequences/03/velodyne/000000.bin", "")
        code, text = self.call("kitti", self.downloads, "--into", self.data)
        self.assertEqual(code, 2)
        self.assertIn("1 of 1 files", text)
        self.assertFalse((self.data / "kitti/sequences/03/velodyne").exists())

    def test_bags_are_asked_for_their_topics(self):
        cloud = "sensor_msgs/PointCloud2"
        good = [("/os1_cloud_node1/points", cloud), ("/os1_cloud_node2/points", cloud),
                ("/leica/pose/relative", "geometry_msgs/PoseStamped")]
        self.write_bag("eee_01/eee_01.bag", good)
        self.write_bag("eee_02/eee_02.bag", good[:1])
        self.write_bag("eee_03/eee_03.bag", good, damaged=True)
        code, text = self.call("ntu_viral", self.downloads, "--into", self.data)
        self.assertEqual(code, 3)
        self.assertTrue((self.data / "ntu_viral/eee_01/eee_01.bag").is_symlink())
        self.assertTrue((self.data / "ntu_viral/eee_01/truth.tum").is_file())
        self.assertFalse((self.data / "ntu_viral/eee_02").exists())
        self.assertIn("has no topic /os1_cloud_node2/points", text)
        self.assertIn("eee_03.bag is damaged", text)

    def test_a_truth_that_was_not_read_to_its_end_is_unfit_every_time(self):
        self.write_bag("eee_01/eee_01.bag", [
            ("/os1_cloud_node1/points", "sensor_msgs/PointCloud2"),
            ("/os1_cloud_node2/points", "sensor_msgs/PointCloud2"),
            ("/leica/pose/relative", "geometry_msgs/PoseStamped")])
        convert = self.folder / "build" / "apps" / "trajlo_convert"
        convert.write_text(PRETENDED_CONVERT + "echo 'the bag is cut' >&2\nexit 3\n")
        for _ in range(2):
            _, text = self.call("ntu_viral", self.downloads, "--into", self.data)
            self.assertIn("UNFIT   ntu_viral/eee_01/eee_01.bag: the bag is cut", text)
            self.assertEqual([path.name for path in (self.data / "ntu_viral/eee_01").iterdir()],
                             ["eee_01.bag"])
        convert.write_text(PRETENDED_CONVERT)
        _, text = self.call("ntu_viral", self.downloads, "--into", self.data)
        self.assertIn("ok      ntu_viral/eee_01/eee_01.bag", text)
        self.assertTrue((self.data / "ntu_viral/eee_01/truth.tum").is_file())

    def test_the_build_is_the_one_that_the_environment_names(self):
        self.write_bag("pendulum.bag", [("/livox/lidar", "livox_ros_driver/CustomMsg")])
        done = subprocess.run(
            [sys.executable, "-B", str(SCRIPTS / "pointlio"), str(self.downloads)],
            capture_output=True, text=True, check=False,
            env={**os.environ, "TRAJLO_BUILD_DIR": str(self.folder / "build")})
        self.assertIn("ok      pointlio/indoor_swing.bag", done.stdout)

    def test_something_else_in_the_place_is_left_alone(self):
        self.write("swing.bag")
        self.write_bag("swing.bag", [("/livox/lidar", "livox_ros_driver/CustomMsg")])
        place = self.data / "pointlio/indoor_swing.bag"
        place.parent.mkdir(parents=True)
        place.write_text("mine", encoding="utf-8")
        code, text = self.call("pointlio", self.downloads, "--into", self.data)
        self.assertEqual(code, 2)
        self.assertIn("left as it is", text)
        self.assertEqual(place.read_text(encoding="utf-8"), "mine")

    def test_wrong_usage_exits_with_one(self):
        self.assertEqual(self.call("kitti", self.folder / "nothing")[0], 1)
        self.assertEqual(self.call("kitti", "--nonsense")[0], 1)

    def test_the_places_are_those_of_the_suites(self):
        """What a suite names as recording or truth is laid out by its script."""
        for suite, script in (("hilti2021", "hilti2021"), ("pointlio", "pointlio")):
            text = (ROOT / "config" / "suites" / f"{suite}.yaml").read_text(encoding="utf-8")
            named = re.findall(r"(?:recording|truth): (\S+)", text)
            named += re.findall(r"\{data\}/(\S+?)\"", text)
            self.assertTrue(named)
            _, output = self.call(script, self.downloads)
            for place in named:
                self.assertIn(f" {place}:", output)


if __name__ == "__main__":
    unittest.main()
