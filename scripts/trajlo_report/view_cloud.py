# SPDX-License-Identifier: MIT
"""The points of the 3-D view: scans of single moments, and map points where these leave holes."""
import dataclasses

import numpy as np
from scipy.spatial import cKDTree

from trajlo_report import files

FARTHEST_M = 1e6  # what is farther is of an estimate that exploded
BUDGET = 1_000_000  # points; an integrated graphics chip turns this many smoothly


@dataclasses.dataclass
class Cloud:
    """First the scans, moment by moment, then points of the map."""
    points: np.ndarray     # N x 3, m
    times: np.ndarray      # of the moment in which a point was seen, s after the begin; or empty
    intensity: np.ndarray  # as recorded, or empty
    moments: np.ndarray    # s after the begin
    first: np.ndarray      # index of each moment's first point, and the end of the last

    @property
    def scan_count(self):
        return int(self.first[-1]) if len(self.first) else 0


def evenly(count, budget):
    """Indices of at most `budget` things at even distances."""
    return np.arange(count) if count <= budget else np.arange(budget) * count // budget


def finite(points):
    """Which points are somewhere: an estimate that explodes takes them along."""
    return (np.abs(points) < FARTHEST_M).all(axis=1)


def begin_of(path):
    """The time (s) that t_s of view.ply counts from."""
    with path.open("rb") as file:
        for line in file:
            words = line.split()
            if words[:2] == [b"comment", b"begin_s"]:
                return float(words[2])
            if words[:1] == [b"end_header"]:
                break
    raise files.ReportError(f"{path} does not say when it begins")


def read_scans(path, begin_s, budget):
    columns = files.read_ply_columns(path)
    missing = {"x", "y", "z", "intensity", "t_s"} - set(columns)
    if missing:
        raise files.ReportError(f"{path} has no {', '.join(sorted(missing))}")
    points = np.stack([columns[axis] for axis in "xyz"], axis=1)
    usable = np.flatnonzero(finite(points))
    keep = usable[evenly(len(usable), budget)]
    times = columns["t_s"][keep]
    moments, first = np.unique(times, return_index=True)
    late = begin_of(path) - begin_s
    return Cloud(points[keep], times + late, np.nan_to_num(columns["intensity"][keep]),
                 moments + late,
                 np.append(first, len(keep)))


def fill(scans, points, budget):
    """Adds the map points that are farthest from all points of scans; these, which have neither
    time nor intensity, take those of the nearest."""
    room = budget - len(scans.points)
    if room <= 0 or not len(points):
        return scans
    points = points[evenly(len(points), 4 * budget)]
    distance, nearest = cKDTree(scans.points).query(points)
    chosen = np.sort(np.argsort(-distance, kind="stable")[:room])
    nearest = nearest[chosen]
    return dataclasses.replace(
        scans, points=np.concatenate([scans.points, points[chosen]]),
        times=np.concatenate([scans.times, scans.times[nearest]]),
        intensity=np.concatenate([scans.intensity, scans.intensity[nearest]]))


def read_cloud(result, begin_s, budget=BUDGET):
    """What a result folder holds of view.ply and map.ply; None without either."""
    none = np.zeros(0, np.float32)
    map_points = np.zeros((0, 3), np.float32)
    if (result / "map.ply").is_file():
        map_points = files.read_ply(result / "map.ply")
        map_points = map_points[finite(map_points)]
    if (result / "view.ply").is_file():
        scans = read_scans(result / "view.ply", begin_s, budget)
        if len(scans.points):
            return fill(scans, map_points, budget)
    if not len(map_points):
        return None
    return Cloud(map_points[evenly(len(map_points), budget)], none, none, none,
                 np.zeros(0, np.int64))


def columns_of(points, cell_m=0.5):
    """A number for the vertical column that each point lies in."""
    x, y = np.floor(points[:, :2] / cell_m).astype(np.int64).T
    return (x << 32) + y


def ceiling_cut(points, path):
    """A height that leaves a ceiling away and shows what is below it; None in the open.

    There is a ceiling if something lies above most of the way."""
    above = points[points[:, 2] > path[:, 2].max() + 0.3]
    way = np.unique(columns_of(path))
    column = columns_of(above)
    over_way = np.isin(column, way)
    covered, index = np.unique(column[over_way], return_inverse=True)
    if len(covered) < 0.5 * len(way):
        return None
    lowest = np.full(len(covered), np.inf)
    np.minimum.at(lowest, index, above[over_way, 2])
    return float(max(np.percentile(lowest, 10) - 0.15, path[:, 2].max() + 0.05))
