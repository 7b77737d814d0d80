# SPDX-License-Identifier: MIT
"""What the tests of the Python package share: the commands, temporary folders, little scans."""
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np

import trajlo

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("TRAJLO_BUILD_DIR", ROOT / "build"))


def run_command(name, *arguments):
    """Runs a command of trajlo, which must succeed."""
    done = subprocess.run([str(BUILD / "apps" / name), *map(str, arguments)],
                          capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise AssertionError(f"{name} ended with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout


class FolderTest(unittest.TestCase):
    """A test with a folder of its own, `self.folder`, that is deleted afterwards."""

    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="trajlo_python_")
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def tum_of(self, trajectory):
        path = self.folder / "written.tum"
        trajectory.save_tum(path, overwrite=True)
        return path.read_bytes()


def room_points(count=2000, seed=1):
    """Points on the walls of a room of 8 x 6 x 3 m, seen from its middle: (N, 3) float64."""
    random = np.random.default_rng(seed)
    size = np.array([4.0, 3.0, 1.5])
    points = random.uniform(-1.0, 1.0, (count, 3)) * size
    wall = random.integers(0, 3, count)
    rows = np.arange(count)
    points[rows, wall] = np.where(random.uniform(size=count) < 0.5, -1.0, 1.0) * size[wall]
    return points


def room_scan(index, seed=1):
    """The scan of a sensor at rest: 0.1 s long, ten a second."""
    points = room_points(seed=seed + index)
    times_s = np.linspace(0.0, 0.1, len(points), endpoint=False)
    return trajlo.Scan(points, times_s, stamp_ns=1_700_000_000_000_000_000 + index * 100_000_000)


def run_room(options=None, scans=8, **more):
    """A finished odometry in that room."""
    odometry = trajlo.Odometry({"threads": 1, **(options or {})}, **more)
    for index in range(scans):
        odometry.add(room_scan(index))
    odometry.finish()
    return odometry
