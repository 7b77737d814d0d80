# SPDX-License-Identifier: MIT
"""Verdicts on the runs of a campaign: what is wrong, and whether the run said so."""
import json
import unittest

import numpy as np
from support import FolderTest

from trajlo_campaign import execute, flags, judge, prepare, scan_folder, soak, truth

START_NS = prepare.START_NS


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


if __name__ == "__main__":
    unittest.main()
