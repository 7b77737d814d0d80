# SPDX-License-Identifier: MIT
"""Faults for a long run, of which the count of each in run.json is known beforehand."""
import collections

import numpy as np

BLOCK_SCANS = 100   # one fault in each: none meets the one before
MARGIN_SCANS = 30   # of a block, before a fault


class Injector:
    """Damages a ScanFolder; `expected` holds what run.json must count, by name."""

    def __init__(self, folder, rng):
        self.folder, self.rng = folder, rng
        self.expected, self.made = collections.Counter(), collections.Counter()
        self.clock_ns = 0  # what all later stamps are off by

    def inject_all(self):
        """One fault in each block, each kind about as often as the others."""
        blocks = (len(self.folder) - MARGIN_SCANS) // BLOCK_SCANS
        order = [KINDS[k % len(KINDS)] for k in range(blocks)]
        self.rng.shuffle(order)
        for block, kind in enumerate(order):
            first = block * BLOCK_SCANS
            if self.clock_ns:
                self.folder.shift(range(first, min(first + BLOCK_SCANS, len(self.folder))),
                                  self.clock_ns)
            kind(self, first + MARGIN_SCANS + int(self.rng.integers(20)))
            self.made[kind.__name__] += 1
        self.folder.shift(range(blocks * BLOCK_SCANS, len(self.folder)), self.clock_ns)
        self.folder.save()

    def spoil_points(self, index, name, change):
        """Changes some points of a scan by change(points, rows)."""
        points = self.folder.points(index)
        rows = self.rng.permutation(len(points))[:int(self.rng.integers(1, len(points) // 3))]
        change(points, rows)
        self.folder.set_points(index, points)
        self.expected[name] += len(rows)


def cut_file(injector, index):
    data = injector.folder.read(index)
    injector.folder.write(index, data[:int(injector.rng.integers(400, len(data) - 100))])
    injector.expected["damaged"] += 1


def zero_length(injector, index):
    injector.folder.write(index, b"")
    injector.expected["damaged"] += 1


def nan_points(injector, index):
    def change(points, rows):
        points["y"][rows] = np.nan
    injector.spoil_points(index, "not_finite", change)


def near_points(injector, index):
    def change(points, rows):
        for axis in "xyz":
            points[axis][rows] = 0.1
    injector.spoil_points(index, "too_near", change)


def far_points(injector, index):
    def change(points, rows):
        points["x"][rows] = 5000.0
    injector.spoil_points(index, "too_far", change)


def wrong_point_times(injector, index):
    def change(points, rows):
        points["time"][rows] = 77.0
    injector.spoil_points(index, "without_time", change)


def covered(injector, index):
    for one in range(index, index + 3):
        points = injector.folder.points(one)
        for axis in "xyz":  # no two scans alike: that would be a driver that hangs
            points[axis] = injector.rng.uniform(0.03, 0.06, len(points))
        injector.folder.set_points(one, points)
        injector.expected["too_near"] += len(points)


def wrong_stamp(injector, index):
    shift_ns = int(injector.rng.choice([-86400, -40, -3, 3, 40, 86400])) * 1_000_000_000
    injector.folder.shift([index], shift_ns)
    injector.expected["stamps_mended"] += 1


def repeated_stamp(injector, index):
    injector.folder.set_stamp(index, injector.folder.stamp(index - 1))
    injector.expected["stamps_mended"] += 1


def swapped_scans(injector, index):
    """Two scans with their own stamps, in the wrong order."""
    folder = injector.folder
    here, there = folder.read(index), folder.read(index + 1)
    folder.write(index, there)
    folder.write(index + 1, here)
    lines = folder.lines
    lines[index], lines[index + 1] = lines[index + 1], lines[index]
    injector.expected["reordered"] += 1


def scan_twice(injector, index):
    """In the place of the next one, which is lost."""
    injector.folder.write(index + 1, injector.folder.read(index))
    injector.folder.lines[index + 1] = injector.folder.lines[index]
    injector.expected["stamp_repeated"] += 1
    injector.expected["wrong_time"] += len(injector.folder.points(index))


def pause(injector, index):
    """Up to half a second without scans."""
    for one in range(index, index + int(injector.rng.integers(2, 6))):
        injector.folder.files[one].unlink()
        injector.folder.lines[one] = None
        injector.expected["not_recorded"] += 1


def clock_step(injector, index):
    """All stamps from here on; the next blocks come with it. By less than a minute only back: of one
    LiDAR nobody can tell a step ahead from a pause."""
    shift_ns = int(injector.rng.choice([-3600, -7, -2, 3600])) * 1_000_000_000
    end = (index // BLOCK_SCANS + 1) * BLOCK_SCANS
    injector.folder.shift(range(index, min(end, len(injector.folder))), shift_ns)
    injector.clock_ns += shift_ns
    injector.expected["clock_steps"] += 1


def jitter(injector, index):
    """Stamps a millisecond or two off, as those of a busy computer: no fault to count."""
    for one in range(index, index + 20):
        injector.folder.shift([one], int(injector.rng.normal(0.0, 1.5e6)))


def stuck(injector, index):
    """The same points twice, with new stamps."""
    data = injector.folder.read(index)
    for one in (index + 1, index + 2):
        injector.folder.write(one, data)
        injector.expected["points_repeated"] += 1
        injector.expected["wrong_time"] += len(injector.folder.points(index))


KINDS = (cut_file, zero_length, nan_points, near_points, far_points, wrong_point_times, covered,
         wrong_stamp, repeated_stamp, swapped_scans, scan_twice, pause, clock_step, stuck, jitter)
