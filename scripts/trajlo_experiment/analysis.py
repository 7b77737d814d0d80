# SPDX-License-Identifier: MIT
"""Numbers behind the figures. A run that failed has an infinite error, so that no median gets
better by losing the hard recordings; a run that is not finished has none (NaN)."""
import dataclasses
import math

import numpy as np

from trajlo_batch import results

BOOTSTRAP = 2000


def error_of(row, metric):
    if row["result"] == results.FAILED:
        return math.inf
    value = row.get(metric)
    return math.nan if row["result"] == results.UNFINISHED or value is None else float(value)


def marks_of(row):
    """The names of the settings that a row belongs to."""
    return row["marks"].split("; ") if row["marks"] else []


def quantile(values, share):
    """Linear between order statistics, also among infinite ones; NaN of nothing."""
    values = np.sort([value for value in values if not math.isnan(value)])
    if not len(values):
        return math.nan
    place = share * (len(values) - 1)
    low, high = values[math.floor(place)], values[math.ceil(place)]
    if low == high or place == math.floor(place):
        return float(low)
    return float(low + (high - low) * (place - math.floor(place)))


def median(values):
    return quantile(values, 0.5)


def wilson(failed, count, z=1.96):
    """The 95 % interval of a rate; it does not shrink to nothing when nothing failed."""
    if not count:
        return math.nan, math.nan
    rate, square = failed / count, z * z / count
    middle = (rate + square / 2) / (1 + square)
    half = z / (1 + square) * math.sqrt(rate * (1 - rate) / count + square / (4 * count))
    return max(0.0, middle - half), min(1.0, middle + half)


def pareto(costs, errors):
    """Indices of those that nothing beats in both, by growing cost."""
    front, best = [], math.inf
    for index in sorted(range(len(costs)), key=lambda i: (costs[i], errors[i])):
        if errors[index] < best:
            front.append(index)
            best = errors[index]
    return front


def recordings_of(rows):
    """(group, seed), in the order of the experiment. Other parameters of the scenario are another
    level of a factor, not another recording."""
    return list(dict.fromkeys((row["group"], row["seed"]) for row in rows))


def error_matrix(rows, metric):
    """Names of points, recordings, and the error of each point on each recording."""
    points = list(dict.fromkeys(row["point"] for row in rows))
    recordings = recordings_of(rows)
    errors = np.full((len(points), len(recordings)), math.nan)
    for row in rows:
        place = points.index(row["point"]), recordings.index((row["group"], row["seed"]))
        errors[place] = error_of(row, metric)
    return points, recordings, errors


def reference_errors(rows, metric, reference):
    """By recording: the error of the reference, or the median over all points where it failed or
    there is none. Also whether it is the reference's everywhere."""
    points, recordings, errors = error_matrix(rows, metric)
    marked = [row["point"] for row in rows if reference in marks_of(row)]
    own = errors[points.index(marked[0])] if marked else np.full(len(recordings), math.nan)
    middle = np.array([median([value for value in column if math.isfinite(value)])
                       for column in errors.T])
    good = np.isfinite(own) & (own > 0)
    return dict(zip(recordings, np.where(good, own, middle))), bool(good.all())


@dataclasses.dataclass
class Ranked:
    """How good a point is over all recordings."""
    point: str
    failed: int
    score: float       # geometric mean of error / reference, over seeds, then over groups
    low: float         # 95 % of the score when seeds are drawn again; NaN where there is one seed
    high: float
    best_share: float  # how often it is the best of all when seeds are drawn again; as above
    errors: dict       # group -> errors of its seeds


def seed_weights(recordings, count, rng):
    """Rows of weights of recordings: seeds drawn with replacement in each group, groups alike."""
    groups = list(dict.fromkeys(group for group, _ in recordings))
    weights = np.zeros((count, len(recordings)))
    for group in groups:
        members = [i for i, (name, _) in enumerate(recordings) if name == group]
        drawn = rng.integers(0, len(members), size=(count, len(members)))
        for place, member in enumerate(members):
            weights[:, member] = (drawn == place).sum(axis=1) / len(members) / len(groups)
    return weights


def fewest_seeds(recordings):
    groups = [group for group, _ in recordings]
    return min((groups.count(group) for group in groups), default=0)


def rank(rows, metric, reference, rng=None):
    """All points that have ended on all recordings, best first: fewest failures, then score.

    The same seeds are drawn for all points: they are compared on the same recordings."""
    points, recordings, errors = error_matrix(rows, metric)
    by_recording, _ = reference_errors(rows, metric, reference)
    whole = ~np.isnan(errors).any(axis=1)
    if not whole.any():
        return []
    points, errors = [name for name, use in zip(points, whole) if use], errors[whole]
    failed = np.isinf(errors)
    scale = np.array([by_recording[recording] for recording in recordings])
    # Recordings on which everything failed say nothing but that.
    scale = np.where(np.isfinite(scale) & (scale > 0), scale, 1.0)
    logs = np.log(np.maximum(np.where(failed, 1.0, errors) / scale, 1e-12))
    weights = seed_weights(recordings, BOOTSTRAP, rng or np.random.default_rng(0))
    drawn = np.where(failed.astype(float) @ weights.T > 0, math.inf, np.exp(logs @ weights.T))
    groups = {group: [i for i, (name, _) in enumerate(recordings) if name == group]
              for group, _ in recordings}
    even = np.zeros(len(recordings))
    for members in groups.values():
        even[members] = 1.0 / len(members) / len(groups)
    # Settings that do the same share what they win.
    best = (drawn == drawn.min(axis=0)) & np.isfinite(drawn)
    wins = (best / np.maximum(best.sum(axis=0), 1)).mean(axis=1)
    # One seed drawn again and again is always the same, which says nothing of its spread.
    spread = fewest_seeds(recordings) > 1
    ranked = []
    for i, name in enumerate(points):
        score = math.inf if failed[i].any() else float(np.exp(logs[i] @ even))
        low, high = (quantile(drawn[i], share) if spread else math.nan for share in (0.025, 0.975))
        ranked.append(Ranked(name, int(failed[i].sum()), score, low, high,
                             float(wins[i]) if spread else math.nan,
                             {group: errors[i, members].tolist()
                              for group, members in groups.items()}))
    return sorted(ranked, key=lambda item: (item.failed, item.score))
