# SPDX-License-Identifier: MIT
"""Options as a dict: the keys, the checks and the messages of the YAML files."""
import pathlib
import subprocess
import unittest

import numpy as np

import trajlo
from support import BUILD, ROOT, FolderTest


class ConfigTest(FolderTest):

    def refused(self, options=None, **more):
        with self.assertRaises(trajlo.ConfigError) as caught:
            trajlo.Odometry(options, **more)
        return str(caught.exception)

    def test_nested_and_dotted_keys_are_the_same(self):
        nested = trajlo.Odometry({"window": {"segments": 3}, "threads": 1})
        dotted = trajlo.Odometry({"window.segments": 3, "threads": 1})
        self.assertEqual(nested.config, dotted.config)
        self.assertIn("segments: 3", nested.config)

    def test_a_dumped_configuration_loads_back(self):
        odometry = trajlo.Odometry({"map.voxel_size_m": 0.1 + 0.2, "solver.kind": "gauss_newton"})
        file = self.folder / "dumped.yaml"
        file.write_text(odometry.config)
        self.assertEqual(trajlo.Odometry(config=file).config, odometry.config)

    def test_messages_are_those_of_the_command(self):
        for options, setting in [
                ({"window.segmants": 3}, "window.segmants=3"),
                ({"window": {"segmants": 3}}, "window.segmants=3"),
                ({"window.segments": 300}, "window.segments=300"),
                ({"window.segments": "many"}, "window.segments=many"),
                ({"solver.kind": "ceries"}, "solver.kind=ceries"),
                ({"nonsense": 1}, "nonsense=1"),
                ({"map.voxel_size_m": float("nan")}, "map.voxel_size_m=NaN"),
                ({"threads": -1}, "threads=-1"),
                ({"sensor.min_range_m": 50.0, "sensor.max_range_m": 10.0},
                 "sensor.min_range_m=50.0,sensor.max_range_m=10.0"),
        ]:
            with self.subTest(setting):
                done = subprocess.run([BUILD / "apps" / "trajlo_run", "--show_config",
                                       f"--set={setting}"], capture_output=True, text=True)
                self.assertEqual(done.returncode, 1)
                expected = done.stderr.splitlines()[0].replace("trajlo_run: ", "")
                self.assertEqual(self.refused(options), expected.replace("--set: ", "options: "))

    def test_names_the_nearest_key(self):
        self.assertIn("did you mean 'window.segments'?", self.refused({"window.segmants": 3}))

    def test_what_is_no_option_is_refused(self):
        self.assertIn("set twice", self.refused({"window.segments": 3, "window": {"segments": 4}}))
        self.assertIn("is a section", self.refused({"window": 3}))
        self.assertIn("must be a dict", self.refused(["window.segments"]))
        self.assertIn("must be a dict", self.refused("window.segments=3"))
        self.assertIn("object", self.refused({"window.segments": object()}))
        self.assertIn("window.segments", self.refused({"window.segments": None}))
        self.assertIn("window.segments", self.refused({"window.segments": -1}))
        self.assertIn("options", self.refused({("window", "segments"): 3}))

    def test_values_of_numpy_and_paths(self):
        T = np.eye(4)
        T[:3, 3] = [0.1, 0.2, 0.3]
        odometry = trajlo.Odometry({
            "window.segments": np.int64(3), "map.voxel_size_m": np.float32(0.5),
            "input.stamps_file": pathlib.Path("stamps.txt"),
            "sensor.T_body_lidar": [{"matrix": T}]})
        self.assertIn("stamps.txt", odometry.config)
        self.assertIn("[0.1, 0.2, 0.3]", odometry.config)

    def test_configurations_by_name_and_by_file(self):
        self.assertIn("ouster", trajlo.configs())
        for name in trajlo.configs():
            with self.subTest(name):
                trajlo.Odometry(config=name)
        by_file = trajlo.Odometry(config=ROOT / "config" / "outdoor.yaml")
        self.assertEqual(trajlo.Odometry(config="outdoor").config, by_file.config)
        both = trajlo.Odometry({"window.segments": 2}, config=["outdoor", "ouster"])
        self.assertIn("segments: 2", both.config)

    def test_a_configuration_that_is_not_there(self):
        self.assertIn("did you mean 'ouster'?", self.refused(config="ouster1"))
        self.assertIn("No such file", self.refused(config="missing.yaml"))
        bad = self.folder / "bad.yaml"
        bad.write_text("window:\n  segmants: 3\n")
        self.assertIn(f"{bad}:2:3: unknown key", self.refused(config=bad))

    def test_every_key_is_explained(self):
        options = trajlo.options()
        self.assertIn("window.segments", options)
        for key, entry in options.items():
            self.assertTrue(entry["doc"], key)
            self.assertTrue(entry["allowed"], key)


if __name__ == "__main__":
    unittest.main()
