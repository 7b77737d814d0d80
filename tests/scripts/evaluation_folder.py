# SPDX-License-Identifier: MIT
"""Writes a folder as trajlo_evaluate does, for tests of what reads one."""
import json
import pathlib

import numpy as np

COLUMNS = ("t_s,x_m,y_m,z_m,qx,qy,qz,qw,x_true_m,y_true_m,z_true_m,"
           "translation_error_m,rotation_error_deg")


def statistics(errors):
    return {"rmse": float(np.sqrt(np.mean(errors**2))), "mean": float(errors.mean()),
            "median": float(np.median(errors)), "std": float(errors.std()),
            "min": float(errors.min()), "max": float(errors.max())}


def trajectory_json(result):
    """What an evaluation says of the trajectory in a folder of trajlo_run."""
    table = np.loadtxt(pathlib.Path(result) / "trajectory.tum")
    return {"begin_s": f"{table[0, 0]:.9f}", "end_s": f"{table[-1, 0]:.9f}", "poses": len(table),
            "path_length_m": float(np.linalg.norm(np.diff(table[:, 1:4], axis=0), axis=1).sum())}


def write_evaluation(folder, noise_m, diverged=(), with_rotation=True, poses=400, of=None):
    """`noise_m` maps the names of estimates to the size of their errors. `of`: the folder of a run
    whose trajectory they are said to be."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    random = np.random.default_rng(1)
    times = 1.7e9 + np.linspace(0, 40, poses)
    phase = np.linspace(0, 2 * np.pi, poses)
    truth = np.stack([12 * np.cos(phase), 7 * np.sin(2 * phase), 1 + 0.8 * np.sin(3 * phase)], 1)
    estimates = []
    for name, size in noise_m.items():
        steps = random.normal(0, size, (poses, 3))
        smooth = np.stack([np.convolve(step, np.ones(25) / 25, "same") for step in steps.T], 1)
        at = truth + 3 * smooth
        if name in diverged:
            at = at + np.exp(np.linspace(-4, 7, poses))[:, None]
        error = np.linalg.norm(at - truth, axis=1)
        rotation = np.abs(random.normal(0, 10 * size, poses))
        if not with_rotation:
            rotation[:] = np.nan
        quaternions = np.tile([0.0, 0.0, 0.0, 1.0], (poses, 1))
        table = np.column_stack([times, at, quaternions, truth, error, rotation])
        lines = [COLUMNS] + [",".join("" if np.isnan(v) else f"{v:.9f}" for v in row)
                             for row in table]
        (folder / f"errors_{name}.csv").write_text("\n".join(lines) + "\n")
        estimates.append({
            "name": name, "file": f"{name}.tum", "trajectory": trajectory_json(of) if of else None,
            "errors_csv": f"errors_{name}.csv",
            "diverged": name in diverged,
            "divergence_reason": "the error grew past 100 m" if name in diverged else "",
            "completeness": 1.0, "pairs": poses, "duration_s": 40.0,
            "path_length_m": float(np.linalg.norm(np.diff(truth, axis=0), axis=1).sum()),
            "ate": {"translation_m": statistics(error),
                    "rotation_deg": statistics(rotation) if with_rotation else None},
            "rpe": [{"delta": 1.0, "unit": "m", "pairs": 60,
                     "translation_m": statistics(error) if with_rotation else None,
                     "rotation_deg": statistics(rotation) if with_rotation else None,
                     "point_distance_m": statistics(0.5 * error)}],
            "kitti": None, "time_offset_s": 0.0,
            "alignment": {"kind": "se3", "T": np.eye(3, 4).tolist(), "scale": 1.0}})
    document = {"estimates": estimates, "truth": {"file": "truth.tum"},
                "settings": {"alignment": "se3", "max_time_difference_s": 0.01},
                "versions": {"trajlo": "0.1.0"}, "warnings": []}
    (folder / "evaluation.json").write_text(json.dumps(document, indent=2))
    return folder
