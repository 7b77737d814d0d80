# SPDX-License-Identifier: MIT
"""Numbers behind the figures. A run that failed has an infinite error, so that no median gets
better by losing the hard recordings; a run that is not finished has none (NaN)."""
import dataclasses
import math

import numpy as np

from trajlo_batch import results

BOOTSTRAP = 2000
COST_NOISE = 0.05  # relative differences of the processor time of equal runs
PRINTED = 0.005  # relative differences that are smaller are not seen in tables


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
    """Indices of those that nothing beats in both, by growing cost. One that is cheaper by less than
    the noise is not cheaper."""
    def beats(one, other):
        if errors[one] == errors[other]:
            return (costs[one], one) < (costs[other], other)
        return errors[one] < errors[other] and costs[one] <= (1 + COST_NOISE) * costs[other]

    places = [i for i in range(len(costs)) if math.isfinite(errors[i])]
    return sorted((i for i in places if not any(beats(other, i) for other in places)),
                  key=lambda i: costs[i])


def recording_of(row):
    """(group, seed). Other parameters of the scenario are another level of a factor, not another
    recording."""
    return row["group"], row["seed"]


def recordings_of(rows):
    """In the order of the experiment."""
    return list(dict.fromkeys(map(recording_of, rows)))


def recordings_without_error(rows, metric):
    """Those on which no run has an error, so that they say nothing about settings: {recording: whether
    all of its runs failed}. Where one did not, it has no such metric."""
    found = {recording: [row for row in rows if recording_of(row) == recording]
             for recording in recordings_of(rows)}
    return {recording: all(row["result"] == results.FAILED for row in own)
            for recording, own in found.items()
            if not any(math.isfinite(error_of(row, metric)) for row in own)}


def error_matrix(rows, metric):
    """Names of points, recordings, and the error of each point on each recording."""
    points = list(dict.fromkeys(row["point"] for row in rows))
    recordings = recordings_of(rows)
    errors = np.full((len(points), len(recordings)), math.nan)
    for row in rows:
        place = points.index(row["point"]), recordings.index(recording_of(row))
        errors[place] = error_of(row, metric)
    return points, recordings, errors


@dataclasses.dataclass(frozen=True)
class Reference:
    """What errors are divided by. Ratios of different recordings do not mix: where the reference has
    no error, nothing is compared with it."""
    errors: dict      # recording -> error; only those that are compared
    recordings: int   # all that there are
    is_marked: bool   # errors of the marked setting; else of each recording's median over settings


def reference_of(rows, metric, reference):
    points, recordings, errors = error_matrix(rows, metric)
    marked = [row["point"] for row in rows if reference in marks_of(row)]
    own = errors[points.index(marked[0])] if marked else np.full(len(recordings), math.nan)
    is_marked = bool((np.isfinite(own) & (own > 0)).any())
    if not is_marked:
        own = [median([value for value in column if math.isfinite(value)]) for column in errors.T]
    return Reference({recording: float(value) for recording, value in zip(recordings, own)
                      if math.isfinite(value) and value > 0}, len(recordings), is_marked)


@dataclasses.dataclass
class Ranked:
    """How good a point is over all recordings."""
    point: str
    failed: int
    score: float       # geometric mean of error / reference, over seeds, then over groups
    low: float         # 95 % of the score when seeds are drawn again; NaN of too few seeds
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


def even_weights(recordings):
    """Groups alike, and the seeds of each."""
    groups = [group for group, _ in recordings]
    return np.array([1.0 / groups.count(group) / len(set(groups)) for group in groups])


def enough_seeds(recordings):
    """Whether seeds that are drawn again tell how far results scatter. Two of a scenario tell their
    distance only, and so do three of a lone one: one draw in 27 has nothing but the least of them,
    and 95 % of the draws reach from the least to the most."""
    groups = [group for group, _ in recordings]
    counts = [groups.count(group) for group in dict.fromkeys(groups)]
    least_alone = math.prod(count ** -count for count in counts)
    return min(counts, default=0) > 2 and least_alone < 0.025


def same_results(one, other):
    """Whether two points have the same error, to the last digit, on every recording, and not only
    failures."""
    return one.errors == other.errors and has_error(one)


def has_error(ranked):
    return any(math.isfinite(error) for errors in ranked.errors.values() for error in errors)


def is_tie(one, other):
    """Whether two points that never failed differ by less than their seeds scatter (two standard
    errors of the difference on the same recordings), or by less than is printed."""
    if not (math.isfinite(one.score) and math.isfinite(other.score)):
        return False
    means, squares, freedom = [], 0.0, 0
    variance_of_mean = 0.0
    for group, errors in one.errors.items():
        ratios = np.log(np.maximum(other.errors[group], 1e-12) / np.maximum(errors, 1e-12))
        means.append(ratios.mean())
        squares += ((ratios - ratios.mean()) ** 2).sum()
        freedom += len(ratios) - 1
        variance_of_mean += 1.0 / len(ratios)
    variance = squares / freedom if freedom else 0.0
    scatter = math.sqrt(variance * variance_of_mean) / len(means)
    return abs(np.mean(means)) < max(2.0 * scatter, PRINTED)


def rank(rows, metric, reference, rng=None):
    """All points that have ended on all recordings, best first: fewest failures, then score.

    The same seeds are drawn for all points: they are compared on the same recordings."""
    points, recordings, errors = error_matrix(rows, metric)
    divisors = reference_of(rows, metric, reference).errors
    whole = ~np.isnan(errors).any(axis=1)
    if not whole.any():
        return []
    points, errors = [name for name, use in zip(points, whole) if use], errors[whole]
    failed = np.isinf(errors)
    # Where every error is zero, or all have failed, there are only failures to compare.
    compared = [recording for recording in recordings if recording in divisors] or recordings
    places = [recordings.index(recording) for recording in compared]
    lost, scale = failed[:, places], np.array([divisors.get(item, 1.0) for item in compared])
    logs = np.log(np.maximum(np.where(lost, 1.0, errors[:, places]) / scale, 1e-12))
    weights = seed_weights(compared, BOOTSTRAP, rng or np.random.default_rng(0))
    drawn = np.where(lost.astype(float) @ weights.T > 0, math.inf, np.exp(logs @ weights.T))
    drawn[np.delete(failed, places, axis=1).any(axis=1)] = math.inf
    even = even_weights(compared)
    # Settings that do the same share what they win.
    best = (drawn == drawn.min(axis=0)) & np.isfinite(drawn)
    wins = (best / np.maximum(best.sum(axis=0), 1)).mean(axis=1)
    spread = enough_seeds(compared)
    ranked = []
    for i, name in enumerate(points):
        score = math.inf if failed[i].any() else float(np.exp(logs[i] @ even))
        low, high = (quantile(drawn[i], share) if spread else math.nan for share in (0.025, 0.975))
        of_group = {}
        for (group, _), error in zip(recordings, errors[i].tolist()):
            of_group.setdefault(group, []).append(error)
        ranked.append(Ranked(name, int(failed[i].sum()), score, low, high,
                             float(wins[i]) if spread else math.nan, of_group))
    return sorted(ranked, key=lambda item: (item.failed, item.score))
