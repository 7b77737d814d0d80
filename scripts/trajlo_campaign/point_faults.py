# SPDX-License-Identifier: MIT
"""Damage to the points of scans. Each fault changes a recording and says what it did."""
import numpy as np

from trajlo_campaign.point_arrays import time_field
from trajlo_campaign.recording import PERIOD_NS


def stretch(recording, rng, longest=20):
    """Some scans in a row."""
    count = int(rng.integers(1, longest))
    first = int(rng.integers(0, max(len(recording) - count, 1)))
    return range(first, min(first + count, len(recording)))


def said(what, scans):
    return f"{what} in scans {scans[0]} to {scans[-1]}"


def set_positions(points, positions):
    for axis, values in zip("xyz", positions):
        points[axis] = values
    return points


def edit_all(recording, scans, change):
    for index in scans:
        recording.edit(index, change)


def covered(recording, rng):
    """Something hangs in front of the LiDAR, at 0.2 to 1.5 m."""
    scans, distance = stretch(recording, rng, 30), float(rng.uniform(0.2, 1.5))

    def cover(points):
        xyz = np.stack([points[axis].astype(float) for axis in "xyz"])
        ranges = np.maximum(np.linalg.norm(np.nan_to_num(xyz), axis=0), 1e-6)
        return set_positions(points, xyz / ranges * distance * rng.uniform(0.97, 1.03, len(points)))
    edit_all(recording, scans, cover)
    return said(f"covered at {distance:.2f} m", scans)


def half_covered(recording, rng):
    """The same for the points on one side."""
    scans, distance = stretch(recording, rng, 60), float(rng.uniform(0.6, 2.0))

    def cover(points):
        xyz = np.stack([points[axis].astype(float) for axis in "xyz"])
        ranges = np.maximum(np.linalg.norm(np.nan_to_num(xyz), axis=0), 1e-6)
        near = xyz / ranges * distance
        return set_positions(points, np.where(xyz[1] > 0, near, xyz))
    edit_all(recording, scans, cover)
    return said(f"one side covered at {distance:.2f} m", scans)


def nothing_seen(recording, rng):
    """All points are zero, or not finite."""
    scans, value = stretch(recording, rng, 25), float(rng.choice([0.0, np.nan, np.inf]))
    edit_all(recording, scans, lambda points: set_positions(points, [value] * 3))
    return said(f"all points {value}", scans)


def few_points(recording, rng):
    """All but a few points are zero."""
    scans, count = stretch(recording, rng, 25), int(rng.integers(1, 60))

    def thin(points):
        gone = rng.permutation(len(points))[count:]
        for axis in "xyz":
            points[axis][gone] = 0.0
        return points
    edit_all(recording, scans, thin)
    return said(f"{count} points", scans)


def outliers(recording, rng):
    """Dust, rain, cross-talk: points anywhere."""
    scans, share = stretch(recording, rng, 60), float(rng.uniform(0.1, 0.7))

    def scatter(points):
        hit = rng.random(len(points)) < share
        for axis in "xyz":
            points[axis][hit] = rng.normal(0.0, 10.0, int(hit.sum()))
        return points
    edit_all(recording, scans, scatter)
    return said(f"{100 * share:.0f} % outliers", scans)


def wild_values(recording, rng):
    """Some coordinates are huge."""
    scans, share = stretch(recording, rng, 30), float(rng.uniform(0.001, 0.05))
    value = float(rng.choice([1e9, -1e20, 3e38]))

    def spoil(points):
        points["x"][rng.random(len(points)) < share] = value
        return points
    edit_all(recording, scans, spoil)
    return said(f"{100 * share:.1f} % of x {value:g}", scans)


def equal_times(recording, rng):
    """All points of a scan have the same time."""
    scans = stretch(recording, rng, 60)

    def freeze(points):
        name = time_field(points)
        if name:
            points[name] = points[name][0] if len(points) else 0
        return points
    edit_all(recording, scans, freeze)
    return said("equal point times", scans)


def wrong_times(recording, rng):
    """Some points have any time, or NaN where the field can hold it."""
    scans, share = stretch(recording, rng, 60), float(rng.uniform(0.001, 0.3))

    def spoil(points):
        name = time_field(points)
        if name:
            hit = rng.random(len(points)) < share
            whole = np.issubdtype(points.dtype[name], np.integer)
            values = rng.integers(0, 2**32, len(points)) if whole else \
                rng.choice([np.nan, -1e3, 1e9, 5.0], len(points))
            points[name] = np.where(hit, values, points[name]).astype(points.dtype[name])
        return points
    edit_all(recording, scans, spoil)
    return said(f"{100 * share:.1f} % wrong point times", scans)


def shuffled_points(recording, rng):
    scans = stretch(recording, rng, 60)
    edit_all(recording, scans, lambda points: points[rng.permutation(len(points))])
    return said("points shuffled", scans)


def late_points(recording, rng):
    """Points carry times of the scan before."""
    scans = stretch(recording, rng, 20)

    def delay(points):
        name = time_field(points)
        if name and not np.issubdtype(points.dtype[name], np.integer):
            points[name] -= PERIOD_NS * 1e-9
        elif name:
            points[name] += PERIOD_NS
        return points
    edit_all(recording, scans, delay)
    return said("point times off by a sweep", scans)


FAULTS = (covered, half_covered, nothing_seen, few_points, outliers, wild_values, equal_times,
          wrong_times, shuffled_points, late_points)
