#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Holds covariances against the errors that runs really had: normalised errors squared (NEES).

  scripts/check_covariance.py RUN/result=RUN/truth.tum [...]
Each RUN/result was written by `trajlo_run --covariance`; all runs are of one kind (a scenario with
many seeds). For each time since the start it prints

  NEES = e' C^-1 e,   T_true = T Exp(e),   both trajectories in the frame of their first pose,

as the mean over the runs divided by its expected value (6; 3 for translation or rotation alone),
with the band in which that ratio lies for 95 of 100 such experiments if the covariance is right.
A ratio above the band is optimistic by that factor: `--set=covariance_scale=RATIO` mends it.
Needs Debian's python3-numpy and python3-scipy.
"""
import argparse
import pathlib
import sys

import numpy as np
from scipy import stats
from scipy.spatial.transform import Rotation, Slerp

PARTS = {"pose": slice(0, 6), "translation": slice(0, 3), "rotation": slice(3, 6)}


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


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", nargs="+", metavar="RESULT=TRUTH")
    parser.add_argument("--every", type=float, default=1.0, help="seconds between lines")
    arguments = parser.parse_args()
    runs = []
    for run in arguments.runs:
        result, _, truth = run.partition("=")
        if not truth:
            sys.exit(f"check_covariance.py: expected RESULT=TRUTH, found '{run}'")
        runs.append(errors_of(pathlib.Path(result), pathlib.Path(truth)))
    count = len(runs)
    end = min(times[-1] for times, _, _ in runs)
    print(f"{count} runs; ratio of mean NEES to its expected value")
    print("  time s " + "".join(f"{part:>13}" for part in PARTS) + "   rms m  rms deg")
    ratios = {part: [] for part in PARTS}
    for moment in np.arange(arguments.every, end + 1e-9, arguments.every):
        errors, covariances = [], []
        for times, all_errors, all_covariances in runs:
            index = np.argmin(np.abs(times - moment))
            errors.append(all_errors[index])
            covariances.append(all_covariances[index])
        errors, covariances = np.array(errors), np.array(covariances)
        line = f"  {moment:6.2f} "
        for part, where in PARTS.items():
            block = covariances[:, where, where]
            nees = np.einsum("ni,ni->n", errors[:, where],
                             np.linalg.solve(block, errors[:, where][..., None])[..., 0])
            ratio = nees.mean() / errors[:, where].shape[1]
            ratios[part].append(ratio)
            line += f"{ratio:13.3g}"
        rms = np.sqrt((errors**2).sum(axis=0) / count)
        print(f"{line}  {np.linalg.norm(rms[:3]):.4f}  {np.degrees(np.linalg.norm(rms[3:])):.4f}")
    for part, where in PARTS.items():
        size = where.stop - where.start
        low, high = stats.chi2.ppf([0.025, 0.975], size * count) / (size * count)
        print(f"{part}: median ratio {np.median(ratios[part]):.3g}; 95 % band of a right one "
              f"{low:.2f} to {high:.2f}")


if __name__ == "__main__":
    main()
