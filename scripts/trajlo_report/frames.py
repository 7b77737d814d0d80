# SPDX-License-Identifier: MIT
"""The frame that a page about a run is drawn in: that of the truth where there is one, so that the
map, the path and the errors fit on each other; else the run's own."""
import dataclasses

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


def is_of(estimate, times, positions):
    """Whether an evaluation is of this trajectory. The name of its file does not tell: a result may
    have been moved, or written anew."""
    said = estimate.metrics.get("trajectory") or {}
    if said.get("begin_s") is None or not len(times):
        return False
    with np.errstate(over="ignore", invalid="ignore"):
        path_m = np.linalg.norm(np.diff(positions, axis=0), axis=1).sum()
    known_m = np.inf if said.get("path_length_m") is None else said["path_length_m"]
    # Runs on one recording have the same times, but never the same path to the micrometre.
    return bool(np.allclose([times[0], times[-1]], [float(said["begin_s"]), float(said["end_s"])],
                            rtol=0, atol=1e-6)
                and np.isclose(path_m, known_m, rtol=1e-9, atol=1e-6))


def estimate_of(times, positions, estimates):
    """The evaluation of a trajectory; None if there is none among them."""
    finite = np.isfinite(times) & np.isfinite(positions).all(axis=1)
    return next((item for item in estimates if is_of(item, times[finite], positions[finite])), None)
