# SPDX-License-Identifier: MIT
"""Runs of a fault campaign follow from seed and number, faults do what they say, verdicts are
right."""
import contextlib
import csv
import importlib.machinery
import importlib.util
import io
import json
import pathlib
import struct
import unittest
import unittest.mock

import numpy as np
from bag_writer import write_bag
from support import SCRIPTS, FolderTest

from trajlo_batch.yaml_lines import SuiteError
from trajlo_campaign import (campaign, draw, execute, file_faults, flags, judge,
                             message_file, point_faults, prepare, report, scan_folder, scenes, simulator_faults,
                             soak, stamp_faults, truth)

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


def line(t_ns, position):
    return f"{scan_folder.seconds(t_ns)} " + " ".join(f"{value:.9f}" for value in position) + \
        " 0 0 0 1\n"


class VerdictTest(FolderTest):
    """A truth of 6 s that goes 12 m along x: poses more than 1 m off are wrong."""

    def setUp(self):
        super().setUp()
        self.truth = self.write("truth.tum", "".join(
            line(START_NS + k * 1_000_000, (5.0 + 0.002 * k, 0.0, 0.0)) for k in range(6001)))
        self.prepared = prepare.Prepared([], [], [0], 0.0, 5.9)

    def verdict(self, error=lambda s: 0.0, flagged=(), code=0, until_s=6.0, log="a message",
                clock_ns=0, flag="gap", said=None):
        """Of a run whose poses are error(s) off along y, with flags from some time to another."""
        times = [START_NS + k * 50_000_000 for k in range(int(until_s / 0.05) + 1)]
        offsets = [(t_ns - START_NS) * 1e-9 for t_ns in times]
        self.write("result/trajectory.tum", "".join(
            line(t_ns + clock_ns, (2.0 * s, error(s), 0.0)) for t_ns, s in zip(times, offsets)))
        self.write("result/windows.csv", "index,end_s,flag_names\n" + "".join(
            f"{k},{scan_folder.seconds(t_ns + clock_ns)},"
            f"{flag if flagged and flagged[0] <= s <= flagged[1] else ''}\n"
            for k, (t_ns, s) in enumerate(zip(times, offsets))))
        summary = {"exit": {"code": code if said is None else said}}
        self.write("result/run.json", json.dumps(summary))
        return judge.judge(execute.Ended(code, 1.0, 50.0), self.folder / "result", log, self.truth,
                           self.prepared)

    def late(self, s):
        return 3.0 if s > 4.0 else 0.0

    def test_what_is_right_is_well(self):
        found = self.verdict()
        self.assertEqual(found.verdict, judge.WELL)
        self.assertLess(found.error_m, 1e-6)
        self.assertAlmostEqual(found.limit_m, 1.0)
        self.assertEqual(self.verdict(lambda s: 0.1 * s).verdict, judge.WELL)

    def test_what_is_wrong_without_a_flag_is_wrong_in_silence(self):
        found = self.verdict(self.late)
        self.assertEqual(found.verdict, judge.SILENT)
        self.assertAlmostEqual(found.end_error_m, 3.0, places=6)
        self.assertAlmostEqual(found.first_wrong_s, 4.05, places=3)
        self.assertEqual(self.verdict(self.late, flagged=(1.0, 2.0)).verdict, judge.SILENT)

    def test_every_wrong_pose_needs_a_flag_that_means_something(self):
        self.assertEqual(self.verdict(self.late, flagged=(4.0, 6.0)).verdict, judge.FLAGGED)
        self.assertEqual(self.verdict(self.late, flagged=(4.0, 5.0)).verdict, judge.CARRIED)
        self.assertEqual(self.verdict(self.late, flagged=(4.5, 6.0)).verdict, judge.SILENT)
        self.assertEqual(
            self.verdict(self.late, flagged=(4.0, 6.0), flag="not_converged").verdict, judge.SILENT)
        self.assertEqual(self.verdict(self.late, flagged=(4.0, 6.0),
                                      flag="not_converged|degenerate").verdict, judge.FLAGGED)

    def test_exit_codes_are_words_too(self):
        self.assertEqual(self.verdict(self.late, code=3).verdict, judge.PARTIAL)
        self.assertEqual(self.verdict(self.late, code=4).verdict, judge.LOST)
        self.assertEqual(self.verdict(code=2).verdict, judge.REFUSED)
        self.assertEqual(self.verdict(code=2, log=" \n").verdict, judge.SILENT)
        self.assertEqual(self.verdict(code=4, said=0).verdict, judge.SILENT)

    def test_poses_that_are_missing_are_a_wrong_result(self):
        self.assertEqual(self.verdict(until_s=3.0).verdict, judge.SILENT)
        self.prepared.last_scan_s = 2.9
        self.assertEqual(self.verdict(until_s=3.0).verdict, judge.WELL)

    def test_poses_without_bound_are_so_whatever_the_exit_code(self):
        for code in (0, 3, 4):
            self.assertEqual(self.verdict(lambda s: 1e3 if s > 5.0 else 0.0, code=code).verdict,
                             judge.UNBOUNDED)
            self.assertEqual(self.verdict(lambda s: np.nan if s == 3.0 else 0.0, code=code).verdict,
                             judge.UNBOUNDED)

    def test_crashes_and_hangs(self):
        self.assertEqual(self.verdict(code=-11).verdict, judge.CRASH)
        self.assertEqual(self.verdict(code=7).verdict, judge.CRASH)
        self.assertEqual(self.verdict(code=execute.HUNG).verdict, judge.HANG)

    def test_a_trajectory_may_be_in_any_clock_of_the_recording(self):
        self.prepared.clocks_ns = [0, 3_600_000_000_000]
        self.assertEqual(self.verdict(clock_ns=3_600_000_000_000).verdict, judge.WELL)
        self.prepared.clocks_ns = [0]
        self.assertEqual(self.verdict(clock_ns=3_600_000_000_000).verdict, judge.SILENT)

    def test_poses_beyond_the_truth_are_wrong(self):
        self.assertEqual(self.verdict(until_s=6.2).verdict, judge.WELL)
        self.assertEqual(self.verdict(until_s=8.0).verdict, judge.SILENT)

    def test_errors_do_not_depend_on_the_frame(self):
        turn = truth.Rotation.from_rotvec([0.3, -0.2, 1.0])
        times = START_NS + np.arange(61) * 100_000_000
        reference = truth.Truth.read(self.truth)
        moved = turn.apply(reference.position(times)) + [4.0, 5.0, 6.0]
        quaternions = np.tile(turn.as_quat(), (61, 1))
        errors = truth.errors_by_pose(reference, (times, moved, quaternions), [0],
                                      np.ones(61, dtype=bool))
        self.assertLess(errors.position_m.max(), 1e-6)

    def test_flags_of_poses_come_before_those_of_windows(self):
        self.verdict(flagged=(4.0, 6.0))
        self.write("result/flags.csv", f"t_s,flag_names\n{scan_folder.seconds(START_NS)},lost\n")
        self.assertEqual(list(flags.flagged_times_ns(self.folder / "result")), [START_NS])


class ExecuteTest(FolderTest):
    def execute(self, text, **limits):
        program = self.executable("program", "#!/bin/sh\n" + text)
        return execute.execute([program], self.folder / "log.txt", **limits).code

    def test_codes_signals_and_limits(self):
        self.assertEqual(self.execute("exit 4"), 4)
        self.assertEqual(self.execute("kill -SEGV $$"), -11)
        self.assertEqual(self.execute("while :; do :; done", cpu_s=1), execute.HUNG)
        self.assertEqual(self.execute("sleep 600", wall_s=0.3), execute.HUNG)


class SoakTest(unittest.TestCase):
    @staticmethod
    def samples(leak_mb):
        """Of a run of an hour: it begins with 100 MB, writes 13 MB, and keeps its poses."""
        written = np.linspace(0.0, 13e6, 1000)
        memory = 100.0 + soak.TRAJECTORY_SHARE * written / 1e6 + np.linspace(0.0, leak_mb, 1000)
        return np.stack([np.arange(1000.0), written, memory], axis=1)

    def test_the_trajectory_is_no_leak(self):
        self.assertAlmostEqual(soak.memory_growth(self.samples(0.0)), 0.0, places=6)

    def test_a_leak_is_seen(self):
        self.assertGreater(soak.memory_growth(self.samples(13.0)), 0.05)


def make_row(number, verdict=judge.WELL, **values):
    return {"run": number, "scene": "hall", "format": "pcd", "faults": "cut + flips",
            "verdict": verdict, "reason": "", "exit_code": 0, "error_m": 0.1 * number,
            "poses_wrong": 0, "first_wrong_s": None, "what": "<b>", **values}


class ReportTest(FolderTest):
    def test_shares_add_up_and_the_page_holds_all_it_shows(self):
        rows = [make_row(k, verdict) for k, verdict in enumerate(judge.VERDICTS)]
        report.write(self.folder, dict(enumerate(rows)), seed=1, version="trajlo_run")
        self.assert_self_contained(self.folder / "report.html")
        self.assertEqual(sum(count for _, count, _, _ in report.shares(rows)), len(rows))
        self.assertIn("10.0 %", (self.folder / "summary.txt").read_text())
        self.assertNotIn("<b>", (self.folder / "report.html").read_text())
        self.assertEqual(len((self.folder / "results.csv").read_text().splitlines()), len(rows) + 1)

    def test_what_is_read_again_makes_the_same_table_and_page(self):
        rows = {7: make_row(7, judge.LOST), 12: make_row(12, judge.UNBOUNDED, error_m=np.inf),
                3: make_row(3, judge.SILENT, poses_wrong=2, first_wrong_s=1.25)}
        found = []
        for _ in range(2):
            report.write(self.folder, rows, 1, "a (b)")
            found.append([(self.folder / name).read_text()
                          for name in ("results.csv", "summary.txt", "report.html")])
            rows = report.read_rows(self.folder, 1, "a (b)")
        self.assertEqual(*found)


def load_script(name):
    """A script without .py, as a module."""
    loader = importlib.machinery.SourceFileLoader(name, str(SCRIPTS / name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
    loader.exec_module(module)
    return module


class GoOnTest(FolderTest):
    """Campaigns whose runs are only pretended; `self.made` holds their numbers."""

    def setUp(self):
        super().setUp()
        self.script, self.build = load_script("fault_campaign"), self.pretend_build()

    def campaign(self, *arguments, until=None, verdict=judge.WELL):
        self.made = []

        def pretend(_, number):
            if number == until:
                raise KeyboardInterrupt
            self.made.append(number)
            return make_row(number, verdict)

        parsed = self.script.make_parser().parse_args(
            [*arguments, f"--build={self.build}", f"--output={self.folder / 'output'}"])
        with unittest.mock.patch.object(campaign.Campaign, "run", pretend), \
                contextlib.redirect_stdout(io.StringIO()):
            return self.script.run(parsed)

    def runs(self):
        with (self.folder / "output" / "results.csv").open() as file:
            return [int(row["run"]) for row in csv.DictReader(file)]

    def test_the_same_command_goes_on_where_one_was_interrupted(self):
        with self.assertRaises(KeyboardInterrupt):
            self.campaign("--runs=5", until=2)
        self.assertEqual(self.runs(), [0, 1])
        self.campaign("--runs=5")
        self.assertEqual((self.made, self.runs()), ([2, 3, 4], [0, 1, 2, 3, 4]))

    def test_runs_before_and_behind_those_that_are_there_are_added(self):
        self.campaign("--first=3", "--runs=2")
        self.campaign("--first=1", "--runs=6")
        self.assertEqual((self.made, self.runs()), ([1, 2, 5, 6], [1, 2, 3, 4, 5, 6]))

    def test_a_run_that_is_named_is_made_again_and_takes_its_place(self):
        self.assertEqual(self.campaign("--runs=3", verdict=judge.SILENT), 3)
        for number in range(3):
            self.assertEqual(self.campaign(f"--only={number}"), 0 if number == 2 else 3)
            self.assertEqual((self.made, self.runs()), ([number], [0, 1, 2]))

    def test_another_seed_or_program_does_not_mix_with_what_is_there(self):
        self.campaign("--runs=2")
        before = (self.folder / "output" / "results.csv").read_text()
        with self.assertRaisesRegex(SuiteError, "seed 1, and this campaign of 2; name another"):
            self.campaign("--runs=3", "--seed=2")
        self.pretend_build("second")
        with self.assertRaisesRegex(SuiteError, "version .*first.*, and this campaign of .*second"):
            self.campaign("--runs=3")
        self.assertEqual((self.folder / "output" / "results.csv").read_text(), before)


class KeepTest(FolderTest):
    def test_a_run_that_is_well_now_leaves_nothing_of_when_it_was_not(self):
        work = campaign.Campaign(None, 1, None, self.folder, self.folder / "kept")
        for verdict in (judge.CRASH, judge.WELL):
            self.write("00003/log.txt", "what it said")
            work.keep(self.folder / "00003", judge.Verdict(verdict), {"run": 3}, ["trajlo_run"])
            self.assertEqual((self.folder / "kept" / "00003").exists(), verdict == judge.CRASH)


if __name__ == "__main__":
    unittest.main()
