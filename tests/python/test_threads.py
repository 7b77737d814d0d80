# SPDX-License-Identifier: MIT
"""Several threads, and one estimator or two."""
import sys
import threading
import time
import unittest

import numpy as np

import trajlo
from support import room_scan, run_room


class ThreadsTest(unittest.TestCase):

    def test_others_run_while_it_computes(self):
        """With such a switch interval, nobody else runs unless the GIL is given away."""
        counted = [0]
        stop = threading.Event()

        def count():
            while not stop.is_set():
                counted[0] += 1
                time.sleep(1e-4)

        interval = sys.getswitchinterval()
        sys.setswitchinterval(1000.0)
        other = threading.Thread(target=count)
        try:
            other.start()
            odometry = trajlo.Odometry({"threads": 1})
            before = counted[0]
            for index in range(200):
                odometry.add(room_scan(index))
                if counted[0] > before:
                    break
            self.assertGreater(counted[0], before)
        finally:
            stop.set()
            sys.setswitchinterval(interval)
            other.join()

    def test_another_thread_that_computes_is_refused_and_one_that_reads_is_not(self):
        """The callback waits, so that the other thread certainly comes in between: were the reads
        to wait for the call around the callback, both would for ever."""
        inside, looked = threading.Event(), threading.Event()
        errors, read = [], []

        def on_window(window):
            inside.set()
            looked.wait(60)

        odometry = trajlo.Odometry({"threads": 1}, on_window=on_window)

        def look():
            inside.wait(60)
            for call in (lambda: odometry.trajectory, lambda: odometry.map,
                         lambda: odometry.windows, lambda: odometry.point_counts,
                         lambda: odometry.add(room_scan(0)), odometry.finish):
                try:
                    read.append(call())
                except trajlo.StateError as error:
                    errors.append(str(error))
            looked.set()

        other = threading.Thread(target=look)
        other.start()
        for index in range(6):
            odometry.add(room_scan(index))
        odometry.finish()
        other.join()
        self.assertEqual((len(errors), len(read)), (2, 4))
        self.assertIn("is computing", errors[0])

    def test_reads_wait_for_the_call_and_are_not_starved_between_calls(self):
        alone = run_room(scans=60).trajectory.poses
        # Made before: between the calls nobody gives the GIL away.
        scans = [room_scan(index) for index in range(60)]
        odometry = trajlo.Odometry({"threads": 1})
        done = threading.Event()
        added = [0]
        errors, calls = [], []

        def look():
            while not done.is_set():
                before = added[0]
                try:
                    odometry.trajectory
                except Exception as error:
                    errors.append(error)
                calls.append(added[0] - before)

        others = [threading.Thread(target=look) for _ in range(3)]
        for other in others:
            other.start()
        try:
            for scan in scans:
                odometry.add(scan)
                added[0] += 1
            odometry.finish()
        finally:
            done.set()
            for other in others:
                other.join(60)
        self.assertEqual(errors, [])
        # Those who waited did so for one call, and not until they came between two by chance.
        waited = [count for count in calls if count > 0]
        self.assertGreater(len(waited), 0)
        self.assertLessEqual(np.median(waited), 2)
        np.testing.assert_array_equal(odometry.trajectory.poses, alone)

    def test_two_odometries_whose_callbacks_read_each_other_do_not_wait_for_ever(self):
        both, errors = [None, None], []

        def work(slot):
            try:
                for index in range(20):
                    both[slot].add(room_scan(index))
            except trajlo.StateError as error:
                errors.append(error)

        def callback(slot):
            return lambda window: both[1 - slot].map

        for slot in (0, 1):
            both[slot] = trajlo.Odometry({"threads": 1}, on_window=callback(slot))
        threads = [threading.Thread(target=work, args=(slot,), daemon=True) for slot in (0, 1)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join(60)
        self.assertFalse(any(thread.is_alive() for thread in threads))
        self.assertEqual(errors, [])

    def test_two_at_a_time_do_not_disturb_each_other(self):
        alone = run_room().trajectory.poses
        results = [None, None]

        def work(slot):
            results[slot] = run_room().trajectory.poses

        threads = [threading.Thread(target=work, args=(slot,)) for slot in (0, 1)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for result in results:
            np.testing.assert_array_equal(result, alone)


if __name__ == "__main__":
    unittest.main()
