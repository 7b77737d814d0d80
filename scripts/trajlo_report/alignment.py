# SPDX-License-Identifier: MIT
"""A rough comparison with the truth, for pictures; trajlo_evaluate is the one to quote."""
import numpy as np

from trajlo_report import files


def align(estimate, truth):
    """The rigid motion (R, t) that brings `estimate` nearest to `truth` (Umeyama, no scale)."""
    mean_e, mean_t = estimate.mean(axis=0), truth.mean(axis=0)
    u, _, vt = np.linalg.svd((truth - mean_t).T @ (estimate - mean_e))
    flip = np.diag([1.0, 1.0, np.sign(np.linalg.det(u @ vt))])
    rotation = u @ flip @ vt
    return rotation, mean_t - rotation @ mean_e


def compare(times, positions, truth_file):
    """Truth in the estimate's frame, and the error (m) at each estimated pose that it covers."""
    truth_times, truth = files.read_tum(truth_file)
    inside = (times >= truth_times[0]) & (times <= truth_times[-1])
    if inside.sum() < 3:
        raise files.ReportError(f"{truth_file} covers fewer than 3 poses of the trajectory")
    at = np.stack([np.interp(times[inside], truth_times, truth[:, i]) for i in range(3)], axis=1)
    rotation, translation = align(at, positions[inside])
    aligned = at @ rotation.T + translation
    error = np.linalg.norm(positions[inside] - aligned, axis=1)
    overlay = truth[(truth_times >= times[0]) & (truth_times <= times[-1])]
    return {"times": times[inside], "error": error, "path": overlay @ rotation.T + translation,
            "rmse": float(np.sqrt(np.mean(error**2)))}
