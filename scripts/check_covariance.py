#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Compares covariances with the actual errors of runs: normalised errors squared (NEES).

  scripts/check_covariance.py RUN/result=RUN/truth.tum [...]
Each RUN/result was written by `trajlo_run --covariance`; all runs are of one kind (a scenario with
many seeds). A covariance is that of a pose relative to the map in view. The place of the
map itself in the world is unknown, so two poses A and B of a run are compared, a second apart
(--apart):

  NEES = e' C^-1 e,   true A^-1 B = (A^-1 B) Exp(e),   C = C_B + Ad C_A Ad',  Ad of B^-1 A.

For each stretch of time it prints the mean over the runs and the poses of the stretch, every
0.05 s, divided by its expected value (6; 3 for translation or rotation alone).
If the covariance is right, that ratio lies in the band printed for 95 of 100 such experiments, and
its mean over time all the more. That mean is the factor by which the covariance is optimistic; its
95 % interval is a bootstrap over the runs, as the poses of a run are correlated (give ten or more:
of fewer it is too narrow; one run tells no more than that a factor outside of the band is not chance).
Needs Debian's python3-numpy and python3-scipy.

Exit codes: 0 done, 1 wrong usage, 2 input unreadable.
"""
import decimal
import pathlib
import sys

import numpy as np
from scipy import stats
from scipy.interpolate import interp1d
from scipy.spatial.transform import Rotation, Slerp

from trajlo_report import command_line, files
from trajlo_report.names import counted

PARTS = {"pose": slice(0, 6), "translation": slice(0, 3), "rotation": slice(3, 6)}
STEP_S = 0.05


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


def adjoints(rotations, translations):
    """Ad of poses, for [rho; theta]."""
    matrices = rotations.as_matrix()
    hats = np.cross(np.eye(3)[None], translations[:, None, :]).transpose(0, 2, 1)
    result = np.zeros((len(translations), 6, 6))
    result[:, :3, :3] = result[:, 3:, 3:] = matrices
    result[:, :3, 3:] = -hats @ matrices
    return result


def read_covariances(path, start_ns):
    """Times of the control poses since the start, and their covariances."""
    lines = path.read_text().split()[1:]
    times = [int(decimal.Decimal(line.partition(",")[0]).scaleb(9)) - start_ns for line in lines]
    table = np.array([line.split(",")[1:] for line in lines], dtype=float).reshape(-1, 21)
    if len(table) < 2:
        raise files.ReportError(f"{path} has no covariances; trajlo_run --covariance writes them")
    covariances = np.zeros((len(table), 6, 6))
    covariances[:, *np.triu_indices(6)] = table
    covariances += np.triu(covariances, 1).transpose(0, 2, 1)
    return np.array(times) * 1e-9, covariances


def require_common_time(result, times, truth_file, t_times):
    """Times since the start of the result."""
    if len(t_times) < 2 or np.any(np.diff(t_times) <= 0):
        raise files.ReportError(f"{truth_file} needs two poses or more, with stamps that increase")
    if not np.any((times >= t_times[0]) & (times <= t_times[-1])):
        raise files.ReportError(
            f"{truth_file} has no time in common with {result}: from the start of the result on, it "
            f"lasts from {t_times[0]:.3f} to {t_times[-1]:.3f} s, and the result to {times[-1]:.3f} s")


def read_poses(path):
    """Stamps, positions and rotations."""
    times_ns, positions, quaternions = files.read_tum(path)
    lengths = np.linalg.norm(quaternions, axis=1)
    if not (np.isfinite(positions).all() and np.isfinite(lengths).all() and (lengths > 1e-6).all()):
        raise files.ReportError(f"{path} has poses that are not finite, or have no rotation")
    return times_ns, positions, Rotation.from_quat(quaternions)


def read_run(result, truth_file):
    """Times since the start, estimated poses, covariances, and the true poses at these times."""
    times_ns, positions, rotations = read_poses(result / "trajectory.tum")
    t_times_ns, t_positions, t_rotations = read_poses(truth_file)
    covariance_times, control_covariances = read_covariances(result / "covariance.csv", times_ns[0])
    times, t_times = (times_ns - times_ns[0]) * 1e-9, (t_times_ns - times_ns[0]) * 1e-9
    require_common_time(result, times, truth_file, t_times)
    inside = (times >= t_times[0]) & (times <= t_times[-1])
    # The first control pose defines the world; nobody has estimated it.
    inside &= (times >= covariance_times[1] - 1e-9) & (times <= covariance_times[-1] + 1e-9)
    true_positions = np.stack(
        [np.interp(times[inside], t_times, t_positions[:, axis]) for axis in range(3)], axis=1)
    true_rotations = Slerp(t_times, t_rotations)(times[inside])
    # With --at or --rate poses lie between control poses; covariance.csv is of these.
    covariances = interp1d(covariance_times, control_covariances, axis=0, bounds_error=False,
                           fill_value=(control_covariances[0], control_covariances[-1]))
    return (times[inside], (positions[inside], rotations[inside]), covariances(times[inside]),
            (true_positions, true_rotations))


def between(poses, first, second):
    """first^-1 second."""
    positions, rotations = poses
    back = rotations[first].inv()
    return back.apply(positions[second] - positions[first]), back * rotations[second]


def errors_of(result, truth_file, apart_s):
    """Times since the start, errors e relative to the pose apart_s before, and covariances C."""
    times, poses, covariances, true_poses = read_run(result, truth_file)
    second = np.flatnonzero(times >= times[0] + apart_s - 1e-6)
    first = np.array([np.argmin(np.abs(times - (times[i] - apart_s))) for i in second], dtype=int)
    if not len(second):
        sys.exit(f"check_covariance.py: '{result}' and its truth share less time than --apart")
    t, r = between(poses, first, second)
    true_t, true_r = between(true_poses, first, second)
    back = r.inv()
    ad = adjoints(back, -back.apply(t))
    together = covariances[second] + ad @ covariances[first] @ ad.transpose(0, 2, 1)
    return times[second], se3_log(back * true_r, back.apply(true_t - t)), together


def nees_ratios(runs, moments):
    """NEES divided by its expected value, by part: an array of moments x runs. And all errors."""
    ratios = {part: np.zeros((len(moments), len(runs))) for part in PARTS}
    errors = np.zeros((len(moments), len(runs), 6))
    for k, (times, all_errors, covariances) in enumerate(runs):
        indices = [np.argmin(np.abs(times - moment)) for moment in moments]
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
    """95 % interval of the mean of a few independent values; a single one has none."""
    if len(values) < 2:
        return np.nan, np.nan
    return stats.bootstrap((values,), np.mean, random_state=1).confidence_interval


def print_stretches(every, moments, ratios, errors):
    count = errors.shape[1]
    print(f"{counted(count, 'run')}; ratio of mean NEES to its expected value")
    print("  until s" + "".join(f"{part:>13}" for part in PARTS) + "   rms m  rms deg")
    ends = np.ceil(moments / every - 1e-9) * every
    for end in np.unique(ends):
        chosen = ends == end
        rms = np.sqrt((errors[chosen]**2).mean(axis=(0, 1)))
        print(f"  {min(end, moments[-1]):7.2f}"
              + "".join(f"{ratios[part][chosen].mean():13.3g}" for part in PARTS)
              + f"  {np.linalg.norm(rms[:3]):.4f}  {np.degrees(np.linalg.norm(rms[3:])):.4f}")


def print_verdict(ratios):
    count = ratios["pose"].shape[1]
    print("mean over time        factor  95 % interval  band of a right one")
    for part, values in ratios.items():
        low, high = interval(values.mean(axis=0))
        right_low, right_high = band(part, count)
        shown = f"{low:7.3g} to {high:<7.3g}" if count > 1 else f"{'–':^18}"
        print(f"  {part:12}  {values.mean():12.3g} {shown}{right_low:8.2f} to {right_high:.2f}")
    factor = ratios["pose"].mean()
    right_low, right_high = band("pose", count)
    word = ("right, as far as these runs can tell" if right_low <= factor <= right_high else
            "optimistic" if factor > 1.0 else "pessimistic")
    if count < 2:
        print(f"Squared errors are {factor:.3g} times what the covariance says"
              + (". One run does not tell whether that is more than chance: give ten or more."
                 if right_low <= factor <= right_high else
                 f", outside of the band of a right one: it is {word}. To know by how much, give ten "
                 "runs or more."))
        return
    low, high = interval(ratios["pose"].mean(axis=0))
    print(f"Squared errors are {factor:.3g} times ({low:.3g} to {high:.3g}) what the covariance says: "
          f"it is {word}.")


def make_parser():
    parser = command_line.Parser(description=__doc__)
    parser.add_argument("runs", nargs="+", metavar="RESULT=TRUTH")
    parser.add_argument("--every", type=float, default=1.0, help="seconds to a line")
    parser.add_argument("--apart", type=float, default=1.0,
                        help="how long before a pose the other one of its pair is (s)")
    parser.add_argument("--begin", type=float, default=0.0,
                        help="leave out what is earlier, such as a start at rest (s)")
    return parser


def check(arguments):
    runs = []
    for run in arguments.runs:
        result, _, truth = run.partition("=")
        if not truth:
            sys.exit(f"check_covariance.py: expected RESULT=TRUTH, found '{run}'")
        runs.append(errors_of(pathlib.Path(result), pathlib.Path(truth), arguments.apart))
    end = min(times[-1] for times, _, _ in runs)
    begin = max(arguments.begin, *(times[0] for times, _, _ in runs))
    moments = np.arange(STEP_S, end + 1e-9, STEP_S)
    moments = moments[moments >= begin - 1e-9]
    if not len(moments):
        sys.exit(f"check_covariance.py: the runs end at {end:.2f} s, before the first line")
    ratios, errors = nees_ratios(runs, moments)
    print_stretches(arguments.every, moments, ratios, errors)
    print_verdict(ratios)
    return 0


if __name__ == "__main__":
    sys.exit(command_line.guarded(make_parser(), check))
