# SPDX-License-Identifier: MIT
"""Callbacks of the estimator: what they are told, and what they may do."""
import unittest
import weakref

import numpy as np

import trajlo
from support import FolderTest, room_scan, run_room


class CallbackTest(FolderTest):

    def test_windows_and_poses_are_told_as_they_come(self):
        windows, poses = [], []
        odometry = run_room(on_window=windows.append, covariance=True,
                            on_pose=lambda t_ns, T, covariance: poses.append((t_ns, T, covariance)))
        for name, column in odometry.windows.items():
            self.assertEqual([window[name] for window in windows], column.tolist())
        self.assertEqual([t_ns for t_ns, _, _ in poses], odometry.trajectory.times_ns.tolist())
        np.testing.assert_array_equal([T for _, T, _ in poses], odometry.trajectory.poses)
        np.testing.assert_array_equal([c for _, _, c in poses], odometry.covariances)

    def test_what_a_callback_raises_comes_out_and_harms_nothing(self):
        plain = run_room()
        calls = []

        def on_window(window):
            calls.append(window)
            if len(calls) in (3, 7):
                raise KeyError(len(calls))

        odometry = trajlo.Odometry({"threads": 1}, on_window=on_window)
        raised = []
        for step in [lambda i=i: odometry.add(room_scan(i)) for i in range(8)] + [odometry.finish]:
            try:
                step()
            except KeyError as error:
                raised.append(error.args[0])
        self.assertEqual(raised, [3, 7])
        self.assertEqual(self.tum_of(odometry.trajectory), self.tum_of(plain.trajectory))
        # The windows after the error of a scan are not told, but kept.
        self.assertEqual(len(odometry.windows["index"]), len(plain.windows["index"]))

    def test_finish_finishes_whatever_a_callback_raises(self):
        def on_pose(t_ns, T, covariance):
            raise KeyError(t_ns)

        odometry = trajlo.Odometry({"threads": 1}, on_pose=on_pose)
        for index in range(8):
            try:
                odometry.add(room_scan(index))
            except KeyError:
                pass
        with self.assertRaises(KeyError):
            odometry.finish()
        self.assertTrue(odometry.is_finished)
        with self.assertRaises(trajlo.StateError):
            odometry.finish()
        self.assertEqual(self.tum_of(odometry.trajectory), self.tum_of(run_room().trajectory))

    def test_callbacks_do_not_keep_a_finished_odometry(self):
        odometry = trajlo.Odometry({"threads": 1}, on_window=lambda window: odometry.trajectory)  # noqa: F821
        for index in range(4):
            odometry.add(room_scan(index))
        odometry.finish()
        held = weakref.ref(odometry)
        del odometry
        self.assertIsNone(held())

    def test_a_callback_may_look_but_not_add(self):
        seen, refused = [], []

        def on_window(window):
            seen.append((len(odometry.trajectory), len(odometry.map)))
            for call in (odometry.finish, lambda: odometry.add(room_scan(0))):
                try:
                    call()
                except trajlo.StateError as error:
                    refused.append(str(error))

        odometry = trajlo.Odometry({"threads": 1}, on_window=on_window)
        for index in range(6):
            odometry.add(room_scan(index))
        odometry.finish()
        self.assertEqual(len(refused), 2 * len(seen))
        self.assertIn("is computing", refused[0])
        self.assertGreater(seen[-1][0], seen[0][0])


if __name__ == "__main__":
    unittest.main()
