# SPDX-License-Identifier: MIT
"""The factor graph of one window, as trajlo_run --inspect writes it."""
import dataclasses
import pathlib

import numpy as np

from trajlo_report import files

COMPONENTS = ("x", "y", "z", "about x", "about y", "about z")
# A standard deviation above this says that nothing holds the direction.
OPEN = 10.0


@dataclasses.dataclass
class WindowGraph:
    """`H` is split by kind of factor; columns of points by name."""
    document: dict
    points: dict
    information: dict  # {"registration": (n, n), "motion": ..., "prior": ...}
    gradient: np.ndarray

    @property
    def index(self):
        return self.document["index"]

    @property
    def poses(self):
        return len(self.document["poses"])

    def total(self, without=()):
        return sum(matrix for kind, matrix in self.information.items() if kind not in without)

    def newest_sigmas(self, without=()):
        """Standard deviations of the newest pose, m and rad in the body frame; infinite where
        nothing is left that holds it."""
        values, vectors = np.linalg.eigh(self.total(without))
        held = np.maximum(values, 1e-12 * values.max())
        covariance = (vectors[-6:] / held) @ vectors[-6:].T
        sigmas = np.sqrt(np.diag(covariance))
        return np.where(sigmas < OPEN, sigmas, np.inf)

    def step_to_minimum(self):
        """How far Gauss-Newton would move the poses from here: largest m and rad."""
        # Where nothing holds a direction, there is no step along it.
        step = np.linalg.lstsq(self.total(), -self.gradient, rcond=None)[0].reshape(-1, 6)
        return np.linalg.norm(step[:, :3], axis=1).max(), np.linalg.norm(step[:, 3:], axis=1).max()

    def segments(self):
        """A row each, for a table."""
        times, poses = self.document["times_ns"], np.array(self.document["poses"])
        for k, segment in enumerate(self.document["segments"]):
            mine = self.points["segment"] == k
            duration_s = 1e-9 * (times[k + 1] - times[k])
            has_points = bool(mine.any())
            yield {**segment, "begin_s": 1e-9 * (times[k] - times[0]), "duration_s": duration_s,
                   "speed_mps": np.linalg.norm(poses[k + 1, :3] - poses[k, :3]) / duration_s,
                   "median_m": float(np.median(np.abs(self.points["distance_m"][mine])))
                   if has_points else float("nan"),
                   "outliers": float((self.points["kernel_weight"][mine] < 0.5).mean())
                   if has_points else float("nan")}


def load(path):
    """Of a file such as windows/000431.json, beside which are its points. Throws ReportError."""
    path = pathlib.Path(path)
    document = files.read_json(path)
    if not isinstance(document, dict) or not {"H", "motion", "prior", "points"} <= document.keys():
        raise files.ReportError(f"{path} is no factor graph: trajlo_run --inspect=N writes one")
    points_path = path.parent / document["points"]
    if not points_path.is_file():
        raise files.ReportError(f"{points_path} is missing")
    whole = np.array(document["H"])
    motion, prior = np.zeros_like(whole), np.zeros_like(whole)
    for into, term in ([(motion, term) for term in document["motion"]]
                       + [(prior, dict(document["prior"], first_pose=0))]):
        jacobian = np.array(term["jacobian"]).reshape(-1, len(term["jacobian"][0])
                                                      if term["jacobian"] else 0)
        at = slice(6 * term["first_pose"], 6 * term["first_pose"] + jacobian.shape[1])
        into[at, at] += jacobian.T @ jacobian
    return WindowGraph(document, files.read_ply_columns(points_path),
                       {"registration": whole - motion - prior, "motion": motion, "prior": prior},
                       np.array(document["g"]))
