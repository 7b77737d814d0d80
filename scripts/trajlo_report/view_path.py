# SPDX-License-Identifier: MIT
"""The trajectory of the 3-D view: where the body was, how fast, and how well it was known."""
import dataclasses

import numpy as np

MOST_POSES = 20_000
SPEED_OVER_S = 0.2  # over less, the noise of the poses looks like speed


@dataclasses.dataclass
class Quantity:
    """One value for each pose, by which the path can be coloured; NaN where it is not known."""
    key: str
    label: str
    unit: str
    values: np.ndarray
    colors: str          # a colour map of matplotlib
    digits: int          # after the decimal point
    is_log: bool = False

    def bounds(self):
        known = self.values[np.isfinite(self.values)]
        if not len(known):
            return 0.0, 1.0
        low, high = np.percentile(known, [1, 99])
        low = 0.0 if self.key in ("speed", "error") else float(low)
        return (low, float(high)) if high > low else (low, low + max(abs(low), 1e-3))


def speeds(times, positions):
    """Speed (m/s) over a short time around each pose."""
    def at(when):
        when = np.clip(when, times[0], times[-1])
        return when, np.stack([np.interp(when, times, positions[:, i]) for i in range(3)], axis=1)

    before, from_here = at(times - SPEED_OVER_S / 2)
    after, to_here = at(times + SPEED_OVER_S / 2)
    span = np.maximum(after - before, 1e-9)
    return np.linalg.norm(to_here - from_here, axis=1) / span


def in_gaps(times, known_times, most_s=1.0):
    """Where the nearest known time is too far to say anything."""
    after = np.searchsorted(known_times, times)
    known = np.concatenate([[-np.inf], known_times, [np.inf]])
    return np.minimum(times - known[after], known[after + 1] - times) > most_s


def interpolated(times, known_times, values):
    known = np.isfinite(known_times) & np.isfinite(values)
    if not known.any():
        return np.full(len(times), np.nan)
    found = np.interp(times, known_times[known], values[known])
    found[in_gaps(times, known_times[known])] = np.nan
    return found


def error_quantity(times, estimate):
    error = interpolated(times, estimate.times, estimate.errors["translation_error_m"])
    known = error[np.isfinite(error)]
    in_cm = len(known) and np.percentile(known, 99) < 1.0
    return Quantity("error", "position error", "cm" if in_cm else "m",
                    100 * error if in_cm else error, "viridis_r", 2)


def quantities(times, positions, windows, estimate):
    """What there is to colour the path by."""
    found = []
    if estimate is not None and len(estimate.errors.get("t_s", ())) > 1:
        found.append(error_quantity(times, estimate))
    found.append(Quantity("speed", "speed", "m/s", speeds(times, positions), "plasma",
                          2))
    if len(windows.get("end_s", ())):
        found.append(Quantity("inliers", "points with a plane", "%", interpolated(
            times, windows["end_s"], 100 * windows["inlier_share"]), "viridis", 0))
        found.append(Quantity("agreement", "points on their plane, in the worst direction", "%",
                              interpolated(times, windows["end_s"], 100 * windows["agreement"]),
                              "viridis", 0))
        found.append(Quantity("eigenvalue", "information in the weakest direction", "1/m²",
                              interpolated(times, windows["end_s"], np.maximum(
                                  windows["smallest_eigenvalue"], 1.0)), "viridis", 0, True))
    return [item for item in found if np.isfinite(item.values).any()]


def flagged_stretches(times, names, begin_s):
    """[{from, to, names}], seconds after the begin, of poses that something speaks against.

    The flags of a pose are those of the time since the pose before."""
    stretches = []
    for index, flags in enumerate(names):
        if not flags:
            continue
        begin, end = float(times[max(index - 1, 0)] - begin_s), float(times[index] - begin_s)
        flags = flags.replace("_", " ").split("|")
        last = stretches[-1] if stretches else None
        if last and last["names"] == flags and begin - last["to"] < 1e-6:
            last["to"] = end
        else:
            stretches.append({"from": begin, "to": end, "names": flags})
    return stretches
