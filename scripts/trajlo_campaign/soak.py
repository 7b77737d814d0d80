# SPDX-License-Identifier: MIT
"""A long run with faults: its memory over time, its clock, and what it counted."""
import os
import pathlib
import subprocess
import time

import numpy as np

from trajlo_campaign import truth
from trajlo_report.files import read_tum

SAMPLE_S = 0.5
# The trajectory is the result, and no leak: a pose takes 104 bytes of memory until the run is over,
# and its line 108 of the file.
TRAJECTORY_SHARE = 104 / 108


def resident_mb(pid):
    """Memory that a process has now; nothing once it has ended."""
    try:
        pages = pathlib.Path(f"/proc/{pid}/statm").read_text().split()[1]
    except (OSError, IndexError):
        return None
    return int(pages) * os.sysconf("SC_PAGE_SIZE") / 1e6


def watch(command, log_file, trajectory):
    """Runs a command; (exit code, rows of seconds, bytes of the trajectory, memory in MB)."""
    samples, begin = [], time.monotonic()
    with log_file.open("w") as log:
        process = subprocess.Popen(["setpriv", "--pdeathsig", "KILL", *map(str, command)],
                                   stdout=log, stderr=subprocess.STDOUT)
        while process.poll() is None:
            memory = resident_mb(process.pid)
            if memory:
                written = trajectory.stat().st_size if trajectory.exists() else 0
                samples.append((time.monotonic() - begin, written, memory))
            time.sleep(SAMPLE_S)
    return process.returncode, np.array(samples)


def memory_growth(samples):
    """How much more memory there is in the last quarter of the run than in the second one, as a
    share, but for the trajectory itself. Progress is measured by what has been written: the machine
    may be busy."""
    progress = samples[:, 1] / samples[-1, 1]
    without_trajectory = samples[:, 2] - TRAJECTORY_SHARE * samples[:, 1] / 1e6
    earlier = without_trajectory[(progress >= 0.25) & (progress < 0.5)]
    later = without_trajectory[progress >= 0.75]
    return float(np.median(later) / np.median(earlier) - 1.0)


def counted(summary):
    """What run.json counts, by the names that the faults use."""
    scans, points = summary["input"]["scans"], summary["input"]["points"]
    return {"damaged": scans["damaged"] + scans["skipped"], "reordered": scans["reordered"],
            "stamp_repeated": scans["stamp_repeated"],
            "stamps_mended": scans["retimed"] + scans["stamp_fits_nowhere"],
            "clock_steps": summary["input"]["clock_steps"],
            "points_repeated": scans["points_repeated"],
            **{name: points[name] for name in ("not_finite", "too_near", "too_far", "wrong_time",
                                               "without_time")}}


def read_sparsely(path, every):
    """One pose of every `every` in a long file."""
    beside = pathlib.Path(path).with_suffix(".sparse")
    with pathlib.Path(path).open() as source, beside.open("w") as target:
        for number, line in enumerate(source):
            if number % every == 0:
                target.write(line)
    return read_tum(beside)


def trajectory_errors(trajectory, truth_file):
    """Errors of all poses, and how far the last one's stamp is from the end of the truth, in s."""
    reference = truth.Truth(*read_sparsely(truth_file, 10))
    poses = read_tum(trajectory)
    errors = truth.errors_by_pose(reference, poses, [0], np.ones(len(poses[0]), dtype=bool))
    return errors.position_m, float((poses[0][-1] - reference.times_ns[-1]) * 1e-9)


def checks(code, summary, expected, growth, errors_m, clock_s):
    """(what, whether it holds, the numbers)."""
    found = counted(summary)
    rows = [("exit code is 3: scans are damaged", code == 3, f"{code}"),
            ("memory is flat", growth < 0.05, f"{100 * growth:+.1f} % from the second quarter"),
            ("the clock has not drifted", abs(clock_s) < 0.15, f"{clock_s:+.3f} s at the end"),
            ("no pose is off", errors_m.max() < 1.0, f"{errors_m.max():.3f} m at most")]
    for name in sorted(set(expected) - {"not_recorded"}):
        rows.append((f"{name} is counted", found[name] == expected[name],
                     f"{found[name]} of {expected[name]}"))
    return rows
