# SPDX-License-Identifier: MIT
"""What a run left in its folder, ready to be drawn: all in one frame."""
import dataclasses
import pathlib

import numpy as np
from scipy.spatial.transform import Rotation

from trajlo_report import files, names, view_cloud, view_path
from trajlo_report.frames import Frame, estimate_of, frame_of


@dataclasses.dataclass
class RunData:
    times: np.ndarray       # s
    positions: np.ndarray   # N x 3, m
    rotations: np.ndarray   # N x 3 x 3, of the body
    windows: dict           # columns of windows.csv
    cloud: view_cloud.Cloud  # or None
    frame: Frame
    estimate: files.Estimate  # the evaluation of this run, or None
    flags: list             # stretches of view_path.flagged_stretches
    missing: list           # a sentence for each file that is not there

    @property
    def begin(self):
        return self.times[0]

    @property
    def is_evaluated(self):
        return self.estimate is not None and len(self.estimate.errors.get("t_s", ())) > 1


def drawable(times, positions, quaternions, missing):
    """Without poses of an estimate that exploded; `missing` is told of them."""
    with np.errstate(over="ignore", invalid="ignore"):
        near = np.linalg.norm(positions - positions[0], axis=1) < view_cloud.FARTHEST_M
        near &= np.linalg.norm(quaternions, axis=1) > 0
    if not near.any():
        raise files.ReportError("The trajectory has no pose that can be drawn")
    if not near.all():
        far_km = view_cloud.FARTHEST_M / 1000
        missing.append(f"Not drawn: {names.counted(np.count_nonzero(~near), 'pose')} more than "
                       f"{far_km:.0f} km from the start, at no place, or without rotation.")
    return times[near], positions[near], quaternions[near]


def load(result, estimates=(), budget=view_cloud.BUDGET):
    """Reads a folder of trajlo_run; of one that was interrupted, what there is. Throws ReportError
    where there is no trajectory."""
    result = pathlib.Path(result)
    if not (result / "trajectory.tum").is_file():
        raise files.ReportError(f"There is no trajectory in {result}")
    missing = []
    times, positions, quaternions = files.read_poses(result / "trajectory.tum")
    estimate = estimate_of(times, positions, estimates)
    times, positions, quaternions = drawable(times, positions, quaternions, missing)
    frame = frame_of(estimate)
    cloud = view_cloud.read_cloud(result, times[0], budget)
    if cloud:
        cloud.points = frame.place(cloud.points)
    else:
        missing.append("There is no map.")
    windows = {}
    if (result / "windows.csv").is_file():
        windows = files.read_columns(result / "windows.csv")
    rotations = Rotation.from_quat(quaternions).as_matrix()
    flags = view_path.flagged_stretches(*files.read_flags(result), times[0])
    return RunData(times, frame.place(positions), frame.turn(rotations), windows, cloud, frame,
                   estimate, flags, missing)
