# SPDX-License-Identifier: MIT
"""A job gives each run the LiDARs that were asked for, and says how it ended."""
import json
import resource
import signal
import subprocess
import unittest

import numpy as np
import yaml
from evaluation_folder import write_evaluation
from result_folder import write_result
from support import FolderTest, built

from trajlo_batch import plan, steps
from trajlo_batch.kitti_calib import camera_in_lidar
from trajlo_batch.places import Places
from trajlo_batch.suite import Sequence
from trajlo_batch.yaml_lines import SuiteError

SCENARIO = """
name: two
lidar0:
  T_body_lidar_matrix: [1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
lidar1:
  T_body_lidar_matrix: [-1, 0, 0, -0.5, 0, -1, 0, 0, 0, 0, 1, 2, 0, 0, 0, 1]
"""
TWO_LIDARS = {"T_body_lidar": [{"translation_m": [1, 0, 0]}, {"translation_m": [2, 0, 0]}]}


class MemoryTest(unittest.TestCase):
    def test_a_megabyte_is_a_million_bytes_as_in_run_json(self):
        usage = resource.struct_rusage([0.0, 0.0, 100_000, *[0] * 13])  # KiB
        self.assertEqual(steps.megabytes(usage), 102.4)


class RigTest(FolderTest):
    def rig(self, job):
        """Inputs, and the options that the job writes."""
        job = {"sequence": "two-seed1", "config": [], "topics": [], "lidars": [],
               "lidar_options": {"input": {}, "sensor": {}}, **job}
        run = self.folder / "plain" / "two-seed1"
        run.mkdir(parents=True, exist_ok=True)
        inputs, files = steps.rig_of(job, self.folder, run)
        rig_file = run / "rig.yaml"
        options = yaml.safe_load(rig_file.read_text()) if rig_file.is_file() else None
        self.assertEqual(files[-1:] == [str(rig_file)], options is not None)
        return inputs, options

    def simulated(self, lidars, **options):
        self.write("truth/two-seed1.yaml", SCENARIO)
        return self.rig({"recording": {"scenario": "two"}, "lidars": lidars,
                         "lidar_options": {"input": {}, "sensor": {}, **options}})

    def test_a_simulated_rig_brings_its_extrinsics(self):
        inputs, options = self.simulated([])
        self.assertEqual([path.rpartition("/")[2] for path in inputs], ["lidar0", "lidar1"])
        second = options["sensor"]["T_body_lidar"][1]["matrix"]
        self.assertEqual(second, [[-1, 0, 0, -0.5], [0, -1, 0, 0], [0, 0, 1, 2]])

    def test_one_of_two_simulated_lidars_keeps_its_own_extrinsics(self):
        inputs, options = self.simulated([1])
        self.assertTrue(inputs[0].endswith("recordings/two-seed1/lidar1"))
        self.assertEqual(options["sensor"]["T_body_lidar"][0]["matrix"][2], [0, 0, 1, 2])

    def test_a_configuration_that_says_where_the_lidars_sit_is_heard(self):
        for lidars, expected in (([], [[1, 0, 0], [2, 0, 0]]), ([1], [[2, 0, 0]])):
            options = self.simulated(lidars, sensor=TWO_LIDARS)[1]
            self.assertEqual(options["sensor"]["T_body_lidar"],
                             [{"translation_m": position} for position in expected])

    def test_one_of_two_topics_keeps_its_own_extrinsics(self):
        rear = {"input": {"topics": ["/rear"]},
                "sensor": {"T_body_lidar": [{"translation_m": [2, 0, 0]}]}}
        topics = ["/front", "/rear"]
        for job in ({"topics": topics, "lidar_options": {"input": {}, "sensor": TWO_LIDARS}},
                    {"lidar_options": {"input": {"topics": topics}, "sensor": TWO_LIDARS}}):
            inputs, options = self.rig({"recording": {"paths": ["a.bag"]}, "lidars": [1], **job})
            self.assertEqual((inputs, options), (["a.bag"], rear))

    def test_lidars_that_are_exchanged_take_all_of_their_options_along(self):
        options = self.simulated([1, 0], sensor=TWO_LIDARS, input={
            "clock_offset_s": [0.0, 0.05], "time_unit": ["ns", "s"]})[1]
        self.assertEqual(options["input"], {"clock_offset_s": [0.05, 0.0],
                                            "time_unit": ["s", "ns"]})
        self.assertEqual([pose["translation_m"][0] for pose in options["sensor"]["T_body_lidar"]],
                         [2, 1])

    def test_options_of_each_lidar_are_found_however_they_are_written(self):
        for text in ("sensor.T_body_lidar: [{translation_m: [1, 0, 0]}, {translation_m: [2, 0, 0]}]\n"
                     "input.clock_offset_s: [0, 0.05]\n",
                     "sensor: {T_body_lidar: [{translation_m: [1, 0, 0]}, {translation_m: [2, 0, 0]}]}"
                     "\ninput: {clock_offset_s: [0, 0.05]}\n"):
            shown = subprocess.run([built("trajlo_run"), "--show_config", "--config",
                                    self.write("rig.yaml", text)], check=True, capture_output=True)
            lists = steps.lists_of_lidars(yaml.safe_load(shown.stdout))
            self.assertEqual(lists["input"], {"clock_offset_s": [0.0, 0.05]})
            self.assertEqual(len(lists["sensor"]["T_body_lidar"]), 2)
        empty = subprocess.run([built("trajlo_run"), "--show_config", "--config",
                                self.write("rig.yaml", "sensor:\n")], check=True,
                               capture_output=True)
        self.assertEqual(steps.lists_of_lidars(yaml.safe_load(empty.stdout)),
                         {"input": {}, "sensor": {}})

    def test_a_plain_recording_needs_no_options(self):
        self.assertEqual(self.rig({"recording": {"paths": ["scans"]}}), (["scans"], None))

    def test_a_lidar_that_is_not_there_is_an_error(self):
        with self.assertRaisesRegex(steps.StepError, "LiDAR 2 was asked for, but there are 2"):
            self.simulated([2])


class RunTest(FolderTest):
    def run_with(self, script, **changes):
        """status.json after a run of a program that only pretends."""
        program = self.executable("program", f"#!/bin/sh\n{script}\n")
        job = {"program": {"path": str(program)}, "recording": {"paths": ["scans"]}, "config": [],
               "set": {"a.b": "1"}, "run": {"at": "scan-end"}, "topics": [], "lidars": [],
               "lidar_options": {"input": {}, "sensor": {}},
               "threads": 2, "timeout_s": 0, "keep_map": True, "sequence": "one",
               "configuration": "plain", "depends_on": {"options": "x"}, **changes}
        path = self.write("plain/one/job.json", json.dumps(job))
        steps.run(path)
        return json.loads((path.parent / "status.json").read_text())

    def test_the_command_carries_all_that_the_job_says(self):
        command = self.run_with("exit 0")["command"]
        self.assertEqual(command[1:], ["--input=scans",
                                       f"--output={self.folder.resolve() / 'plain/one/result'}",
                                       "--threads=2", "--set=a.b=1", "--at=scan-end"])

    def test_exit_codes_are_kept_with_the_last_message(self):
        status = self.run_with("echo 'no such file' >&2; echo '  Give another.' >&2; exit 2")
        self.assertEqual((status["exit_code"], status["reason"]),
                         (2, "input unreadable: no such file; Give another."))

    def test_of_a_long_log_the_reason_is_what_the_program_said(self):
        status = self.run_with("echo 'trajlo_run: unknown flag --rat; did you mean --rate?' >&2; "
                               "echo '(trajlo_run --help shows examples)' >&2; exit 1")
        self.assertEqual(status["reason"], "configuration refused: trajlo_run: unknown flag --rat; "
                                           "did you mean --rate?")

    def test_a_message_of_several_lines_is_kept_whole_on_one(self):
        status = self.run_with("printf 'trajlo_run: a.bag: no topic; there are:\\n    /front\\n"
                               "    /rear\\n  Set input.topics.\\n(--help shows more)\\n'; exit 2")
        self.assertEqual(status["reason"], "input unreadable: trajlo_run: a.bag: no topic; there "
                                           "are: /front; /rear; Set input.topics.")

    def test_the_summary_of_a_run_is_no_part_of_the_message(self):
        status = self.run_with("printf 'trajlo_run: no point can be used\\n  input       3 of 3 scans\\n"
                               "  windows     none\\n  result      no_usable_points\\n'; exit 2")
        self.assertEqual(status["reason"], "input unreadable: trajlo_run: no point can be used")

    def test_what_says_nothing_of_the_method_is_no_result(self):
        for code in (5, 126, 127):
            with self.assertRaisesRegex(steps.StepError, "hindered: trajlo_run: disk full"):
                self.run_with(f"echo 'trajlo_run: disk full' >&2; exit {code}")
            self.assertFalse((self.folder / "plain/one/status.json").is_file())

    def test_a_signal_is_a_crash(self):
        status = self.run_with("kill -ABRT $$")
        self.assertEqual((status["exit_code"], status["reason"]),
                         (-signal.SIGABRT, "crashed: SIGABRT"))

    def test_a_run_that_takes_too_long_is_ended(self):
        status = self.run_with("exec sleep 60", timeout_s=0.2)
        self.assertEqual(status["reason"], "longer than 0.2 s")

    def test_a_map_that_nobody_wants_is_dropped(self):
        for keep in (True, False):
            script = 'r="${2#--output=}"; mkdir -p "$r"; touch "$r/map.ply" "$r/run.json"'
            (self.folder / "plain/one/status.json").unlink(missing_ok=True)
            self.run_with(script, keep_map=keep)
            result = self.folder / "plain/one/result"
            self.assertEqual((result / "map.ply").is_file(), keep)
            self.assertTrue((result / "run.json").is_file())

    def test_an_interrupted_run_has_no_status_so_that_it_is_done_again(self):
        with self.assertRaisesRegex(steps.StepError, "interrupted"):
            self.run_with("exit 130")
        self.assertFalse((self.folder / "plain/one/status.json").exists())

    def test_what_a_killed_run_left_is_removed_and_what_is_done_stays(self):
        self.write("plain/one/result/half.txt", "half")
        self.run_with("exit 0")
        self.assertFalse((self.folder / "plain/one/result").exists())
        self.assertEqual(self.run_with("exit 1")["exit_code"], 0)


class DrawTest(FolderTest):
    def test_the_page_of_a_run_has_pictures_alone_which_are_quick_to_draw(self):
        run = self.folder / "plain" / "one"
        write_result(run / "result")
        write_evaluation(run / "evaluation", {"plain": 0.01}, of=run / "result")
        steps.draw(self.write("plain/one/evaluation_status.json", "{}"))
        drawn = list((run / "page" / "figures").iterdir())
        self.assertEqual({path.suffix for path in drawn}, {".png"})
        self.assertLess({"map", "windows", "thumbnail", "over_time"}, {path.stem for path in drawn})
        self.assert_self_contained(run / "page" / "run.html")
        self.assertIn("one · plain", (run / "page" / "run.html").read_text())


class EvaluationFlagsTest(FolderTest):
    def test_kitti_truth_is_moved_from_the_camera_to_the_lidar(self):
        self.write("data/calib.txt", "P0: 1 2\nTr: 0 -1 0 0.1 0 0 -1 0.2 1 0 0 0.3\n")
        sequence = Sequence(name="00", group="00", evaluate={
            "kitti_calib": "{data}/calib.txt", "times": "{data}/times.txt"})
        places = Places(self.folder, self.folder / "data", self.folder)
        flags = plan.evaluation_flags(places, None, sequence)[0]
        self.assertEqual(flags["times"], str(self.folder / "data" / "times.txt"))
        pose = np.array(flags["T_body_truth"].split(","), dtype=float).reshape(3, 4)
        # A point 1 m ahead of the camera lies ahead of the LiDAR: x is its way forward.
        np.testing.assert_allclose(pose @ [0, 0, 1, 1], [1 - 0.3, 0.1, 0.2], atol=1e-12)

    def test_a_calibration_without_the_lidar_is_named(self):
        with self.assertRaisesRegex(SuiteError, "has no row Tr"):
            camera_in_lidar(self.write("calib.txt", "P0: 1 2\n"))


if __name__ == "__main__":
    unittest.main()
