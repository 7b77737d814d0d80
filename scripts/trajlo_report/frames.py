# SPDX-License-Identifier: MIT
"""The frame that a page about a run is drawn in: that of the truth where there is one, so that the
map, the path and the errors fit on each other; else the run's own."""
import dataclasses
import pathlib

import numpy as np


@dataclasses.dataclass(frozen=True)
class Frame:
    """p_shown = scale * rotation @ p_run + translation."""
    rotation: np.ndarray = dataclasses.field(default_factory=lambda: np.eye(3))
    translation: np.ndarray = dataclasses.field(default_factory=lambda: np.zeros(3))
    scale: float = 1.0
    text: str = "in the run's own frame: the body at the start"

    def place(self, points):
        return self.scale * (points @ self.rotation.T) + self.translation

    def turn(self, rotations):
        return self.rotation @ rotations


def frame_of(estimate):
    """The frame of the truth, by the alignment of the evaluation; the run's own without one."""
    alignment = (estimate.metrics.get("alignment") or {}) if estimate else {}
    if not alignment.get("T"):
        return Frame()
    matrix = np.array(alignment["T"], dtype=float)
    return Frame(matrix[:, :3], matrix[:, 3], float(alignment["scale"]),
                 "in the frame of the truth, after alignment")


def estimate_of(result, estimates):
    """The evaluation of the trajectory in this folder: the one of its file, else the only one."""
    trajectory = (pathlib.Path(result) / "trajectory.tum").resolve()
    own = [item for item in estimates
           if pathlib.Path(item.metrics.get("file", "")).resolve() == trajectory]
    if own:
        return own[0]
    return estimates[0] if len(estimates) == 1 else None
