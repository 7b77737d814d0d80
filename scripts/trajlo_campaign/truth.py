# SPDX-License-Identifier: MIT
"""How far the poses of a run are from the truth, one by one."""
import dataclasses

import numpy as np
from scipy.spatial.transform import Rotation

from trajlo_report.files import read_tum

ANCHOR_POSES = 10
NO_TRUTH_REACH_S = 0.3  # poses farther from all truth have an infinite error


@dataclasses.dataclass(frozen=True)
class Truth:
    times_ns: np.ndarray
    positions: np.ndarray
    quaternions: np.ndarray

    @classmethod
    def read(cls, path):
        return cls(*read_tum(path))

    @property
    def path_m(self):
        return float(np.linalg.norm(np.diff(self.positions, axis=0), axis=1).sum())

    def seconds(self, times_ns):
        return (times_ns - self.times_ns[0]) * 1e-9

    def position(self, times_ns):
        at = self.seconds(self.times_ns)
        return np.stack([np.interp(self.seconds(times_ns), at, column)
                         for column in self.positions.T], axis=1)

    def rotation(self, times_ns):
        """That of the nearest true pose: they are a millisecond apart."""
        index = np.clip(np.searchsorted(self.times_ns, times_ns), 0, len(self.times_ns) - 1)
        return Rotation.from_quat(self.quaternions[index])

    def outside_s(self, times_ns):
        """How far times are before the first or after the last true pose."""
        at, end = self.seconds(times_ns), self.seconds(self.times_ns[-1])
        return np.maximum(0.0, np.maximum(-at, at - end))


@dataclasses.dataclass(frozen=True)
class Errors:
    true_times_ns: np.ndarray  # by the clock under which a pose fits best
    position_m: np.ndarray     # infinite where a pose is not finite, or where there is no truth
    farthest_m: float          # from the first pose


def finite_poses(positions, quaternions):
    norms = np.linalg.norm(quaternions, axis=1)
    return np.isfinite(positions).all(axis=1) & np.isfinite(norms) & (norms > 0.5)


def farthest_m(positions, finite):
    if not len(positions):
        return 0.0
    if not finite.all():
        return np.inf
    return float(np.linalg.norm(positions - positions[0], axis=1).max())


def aligned(truth, true_times_ns, positions, quaternions, anchors):
    """Positions in the frame of the truth: the mean over some poses tells how the frames lie."""
    turn = (truth.rotation(true_times_ns[anchors])
            * Rotation.from_quat(quaternions[anchors]).inv()).mean()
    shift = (truth.position(true_times_ns[anchors]) - turn.apply(positions[anchors])).mean(axis=0)
    return turn.apply(positions) + shift


def errors_by_pose(truth, poses, clocks_ns, trusted):
    """Errors of `poses` (times, positions, quaternions), whose stamps may be of any of the
    recording's clocks: a clock that steps may be followed, or not. The trajectory is laid upon the
    truth by its first trusted poses."""
    times_ns, positions, quaternions = poses
    finite = finite_poses(positions, quaternions)
    positions = np.where(finite[:, None], positions, 0.0)
    quaternions = np.where(finite[:, None], quaternions, (0.0, 0.0, 0.0, 1.0))
    clocks = np.array(sorted(set(clocks_ns)), dtype=np.int64)
    true_times = times_ns[:, None] - clocks
    fits = np.stack([truth.outside_s(column) < NO_TRUTH_REACH_S for column in true_times.T], axis=1)
    fits &= finite[:, None]
    best = Errors(true_times[:, 0], np.full(len(times_ns), np.inf),
                  farthest_m(positions, finite))
    for clock in range(len(clocks)):
        anchors = np.flatnonzero(fits[:, clock] & trusted)[:ANCHOR_POSES]
        if not len(anchors):
            anchors = np.flatnonzero(fits[:, clock])[:ANCHOR_POSES]
        if not len(anchors):
            continue
        moved = aligned(truth, true_times[:, clock], positions, quaternions, anchors)
        errors = np.stack([np.linalg.norm(moved - truth.position(column), axis=1)
                           for column in true_times.T], axis=1)
        errors[~fits] = np.inf
        chosen = errors.argmin(axis=1)
        found = errors[np.arange(len(errors)), chosen]
        if np.minimum(found, 10.0).sum() < np.minimum(best.position_m, 10.0).sum():
            best = Errors(true_times[np.arange(len(errors)), chosen], found, best.farthest_m)
    return best
