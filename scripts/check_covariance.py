#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Holds covariances against the errors that runs really had: normalised errors squared (NEES).

  scripts/check_covariance.py RUN/result=RUN/truth.tum [...]
Each RUN/result was written by `trajlo_run --covariance`; all runs are of one kind (a scenario with
many seeds). For each stretch of time since the start it prints

  NEES = e' C^-1 e,   T_true = T Exp(e),   both trajectories in the frame of their first pose,

as the mean over the runs and the poses of the stretch, every 0.05 s, divided by its expected value
(6; 3 for translation or rotation alone).
If the covariance is right, that ratio lies in the band printed for 95 of 100 such experiments, and
its mean over time all the more. That mean is the factor by which the covariance is optimistic; its
95 % interval is a bootstrap over the runs, for the times of a run hang together (give ten or more:
of fewer it is too narrow). The option printed last gives the calibrated covariance: covariances are
multiplied by it, and nothing else changes.
One factor makes the mean right, not every time: errors of the map add up, the covariance's do not.
Needs Debian's python3-numpy and python3-scipy.
"""
import argparse
import pathlib
import re
import sys

import numpy as np
from scipy import stats
from scipy.spatial.transform import Rotation, Slerp

PARTS = {"pose": slice(0, 6), "translation": slice(0, 3), "rotation": slice(3, 6)}
STEP_S = 0.05


def read_poses(path):
    """Times from the first pose on (s, exact to the nanosecond), positions, rotations."""
    rows = [line.split() for line in pathlib.Path(path).read_text().splitlines()
            if line and not line.startswith("#")]
    seconds = np.array([int(row[0].split(".")[0]) for row in rows])
    fractions = np.array([float("0." + row[0].split(".")[1]) for row in rows])
    values = np.array([[float(value) for value in row[1:8]] for row in rows])
    return seconds, fractions, values[:, :3], Rotation.from_quat(values[:, 3:])


def relative(seconds, fractions, zero):
    return (seconds - zero[0]) + (fractions - zero[1])


def se3_log(rotations, translations):
    """[rho; theta] of poses: rho = V(theta)^-1 t."""
    theta = rotations.as_rotvec()
    angle = np.linalg.norm(theta, axis=1, keepdims=True)
    small = angle < 1e-6
    safe = np.where(small, 1.0, angle)
    factor = np.where(small, 1 / 12.0,
                      (1 - safe * np.sin(safe) / (2 * (1 - np.cos(safe)))) / safe**2)
    cross = np.cross(theta, translations)
    return np.hstack([translations - 0.5 * cross + factor * np.cross(theta, cross), theta])


def errors_of(result, truth_file):
    """Times since the start, errors e and covariances of one run."""
    seconds, fractions, positions, rotations = read_poses(result / "trajectory.tum")
    zero = (seconds[0], fractions[0])
    times = relative(seconds, fractions, zero)
    t_seconds, t_fractions, t_positions, t_rotations = read_poses(truth_file)
    t_times = relative(t_seconds, t_fractions, zero)
    inside = (times >= t_times[0]) & (times <= t_times[-1])
    true_positions = np.stack(
        [np.interp(times[inside], t_times, t_positions[:, axis]) for axis in range(3)], axis=1)
    true_rotations = Slerp(t_times, t_rotations)(times[inside])
    first = true_rotations[0].inv()
    true_positions = first.apply(true_positions - true_positions[0])
    true_rotations = first * true_rotations
    positions, rotations = positions[inside], rotations[inside]
    back = rotations.inv()
    errors = se3_log(back * true_rotations, back.apply(true_positions - positions))
    table = np.genfromtxt(result / "covariance.csv", delimiter=",", skip_header=1)[inside, 1:]
    covariances = np.zeros((len(table), 6, 6))
    covariances[:, *np.triu_indices(6)] = table
    covariances += np.triu(covariances, 1).transpose(0, 2, 1)
    return times[inside], errors, covariances


def nees_ratios(runs, moments):
    """NEES divided by its expected value, by part: an array of moments x runs. And all errors."""
    ratios = {part: np.zeros((len(moments), len(runs))) for part in PARTS}
    errors = np.zeros((len(moments), len(runs), 6))
    for k, (times, all_errors, covariances) in enumerate(runs):
        # The first pose defines the frame: it has no error and no covariance.
        indices = [1 + np.argmin(np.abs(times[1:] - moment)) for moment in moments]
        errors[:, k] = all_errors[indices]
        for part, where in PARTS.items():
            e = errors[:, k, where]
            weighted = np.linalg.solve(covariances[indices][:, where, where], e[..., None])[..., 0]
            ratios[part][:, k] = np.einsum("ni,ni->n", e, weighted) / e.shape[1]
    return ratios, errors


def band(part, count):
    """Where the mean ratio over `count` runs lies if the covariance is right."""
    size = (PARTS[part].stop - PARTS[part].start) * count
    return stats.chi2.ppf([0.025, 0.975], size) / size


def interval(values):
    """95 % interval of the mean of a few independent values; a single one tells nothing."""
    if len(values) < 2:
        return 0.0, np.inf
    return stats.bootstrap((values,), np.mean, random_state=1).confidence_interval


def scale_of(result):
    """The covariance_scale that a run was made with."""
    found = re.search(r"^covariance_scale: *(\S+)", (result / "config.yaml").read_text(), re.M)
    return float(found[1])


def print_stretches(every, moments, ratios, errors):
    count = errors.shape[1]
    print(f"{count} runs; ratio of mean NEES to its expected value")
    print("  until s" + "".join(f"{part:>13}" for part in PARTS) + "   rms m  rms deg")
    ends = np.ceil(moments / every - 1e-9) * every
    for end in np.unique(ends):
        chosen = ends == end
        rms = np.sqrt((errors[chosen]**2).mean(axis=(0, 1)))
        print(f"  {min(end, moments[-1]):7.2f}"
              + "".join(f"{ratios[part][chosen].mean():13.3g}" for part in PARTS)
              + f"  {np.linalg.norm(rms[:3]):.4f}  {np.degrees(np.linalg.norm(rms[3:])):.4f}")


def print_verdict(ratios, scale):
    count = ratios["pose"].shape[1]
    factor = ratios["pose"].mean()
    print("mean over time        factor  95 % interval  band of a right one  with the option below")
    for part, values in ratios.items():
        low, high = interval(values.mean(axis=0))
        right_low, right_high = band(part, count)
        print(f"  {part:12}  {values.mean():12.3g} {low:7.3g} to {high:<7.3g}"
              f"{right_low:8.2f} to {right_high:.2f} {values.mean() / factor:17.2f}")
    low, high = interval(ratios["pose"].mean(axis=0))
    right_low, right_high = band("pose", count)
    word = ("right, as far as these runs can tell" if right_low <= factor <= right_high else
            "optimistic" if factor > 1.0 else "pessimistic")
    print(f"Squared errors are {factor:.3g} times ({low:.3g} to {high:.3g}) what the covariance says: "
          f"it is {word}.\nThe calibrated one:  --set=covariance_scale={scale * factor:.4g}")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", nargs="+", metavar="RESULT=TRUTH")
    parser.add_argument("--every", type=float, default=1.0, help="seconds to a line")
    parser.add_argument("--begin", type=float, default=0.0,
                        help="leave out what is earlier, such as a start at rest (s)")
    arguments = parser.parse_args()
    runs, scales = [], set()
    for run in arguments.runs:
        result, _, truth = run.partition("=")
        if not truth:
            sys.exit(f"check_covariance.py: expected RESULT=TRUTH, found '{run}'")
        runs.append(errors_of(pathlib.Path(result), pathlib.Path(truth)))
        scales.add(scale_of(pathlib.Path(result)))
    if len(scales) > 1:
        sys.exit(f"check_covariance.py: the runs differ in covariance_scale: {sorted(scales)}")
    end = min(times[-1] for times, _, _ in runs)
    moments = np.arange(STEP_S, end + 1e-9, STEP_S)
    moments = moments[moments >= arguments.begin - 1e-9]
    if not len(moments):
        sys.exit(f"check_covariance.py: the runs end at {end:.2f} s, before the first line")
    ratios, errors = nees_ratios(runs, moments)
    print_stretches(arguments.every, moments, ratios, errors)
    print_verdict(ratios, scales.pop())


if __name__ == "__main__":
    main()
