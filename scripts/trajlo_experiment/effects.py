# SPDX-License-Identifier: MIT
"""What each factor does to the error, in sentences."""
import dataclasses
import math

import numpy as np
from scipy import stats

from trajlo_experiment import analysis
from trajlo_experiment.factors import level_of, parts_of
from trajlo_report import names

CHANCE = 0.05   # how often any of the factors may seem to matter by nothing but chance
SHUFFLES = 10000
SMALL = 1.05    # ratios of mean errors up to here are not worth a word


@dataclasses.dataclass(frozen=True)
class Level:
    """What all runs with one value of a factor, or in one part of its range, say together."""
    text: str      # "σ = 0.1 m"
    mean: float    # geometric, of the settings that ended well everywhere; infinite if none did
    failed: int
    runs: int
    is_part: bool  # of a range

    @property
    def lost(self):
        return self.failed / self.runs


def scores_of(findings, item):
    """Of the settings of a bin that have ended."""
    return [findings.scores[name].score for name in dict.fromkeys(row["point"] for row in item.rows)
            if name in findings.scores]


def levels_of(findings, factor):
    found = []
    for item in findings.bins(factor):
        scores = scores_of(findings, item)
        finite = [score for score in scores if math.isfinite(score)]
        failed = [math.isinf(error) for error in findings.errors(item.rows)]
        if scores:
            mean = float(np.exp(np.mean(np.log(finite)))) if finite else math.inf
            found.append(Level(level_of(factor, item.label), mean, sum(failed), len(failed),
                               len({row[factor.name] for row in item.rows}) > 1))
    return found


def without_effect(findings, ranked):
    """Factors whose settings, where nothing else differs, have the same errors on every run."""
    levels = {point.name: point.levels for point in findings.study.points if point.in_design}
    said = []
    for factor in findings.study.factors:
        alike = {}
        for item in ranked:
            # Where a setting failed on everything, nothing is seen of what it does.
            if factor.name in levels.get(item.point, {}) and analysis.has_error(item):
                others = sorted((name, str(level)) for name, level in levels[item.point].items()
                                if name != factor.name)
                alike.setdefault(str(others), []).append(item)
        compared = [items for items in alike.values() if len(items) > 1]
        if compared and all(analysis.same_results(items[0], item)
                            for items in compared for item in items):
            said.append(f"{parts_of(factor.label)[0]} has no effect here: settings that differ in it "
                        "alone gave exactly the same results.")
    return said


def ratio_of(levels):
    """Between the means of the worst and the best; a value with which no setting ended well is worse
    than any other."""
    means = [level.mean for level in levels]
    return max(means) / min(means) if math.isfinite(min(means, default=math.inf)) else 1.0


def chance(findings, factor):
    """How often settings differ at least as much between the values of a factor, if their errors are
    dealt to them at random. In a sampled design all factors differ between any two settings, and few
    settings differ much between any two halves."""
    scores = [scores_of(findings, item) for item in findings.bins(factor)]
    scores = [own for own in scores if own]
    ranks = stats.rankdata(np.concatenate(scores))  # one that failed is behind all that did not
    begins = np.cumsum([0, *map(len, scores)])[:-1]
    counts = np.array([len(own) for own in scores])

    def spread(dealt):
        return (np.add.reduceat(dealt, begins, axis=-1) ** 2 / counts).sum(axis=-1)

    dealt = np.random.default_rng(0).permuted(np.tile(ranks, (SHUFFLES, 1)), axis=1)
    return (1 + np.sum(spread(dealt) >= spread(ranks) * (1 - 1e-9))) / (1 + SHUFFLES)


def of_runs(level):
    return f"{level.failed} of {names.counted(level.runs, 'run')} failed with {level.text}"


def mean_text(levels):
    return "the mean error" + (" of settings that never failed"
                               if any(level.failed for level in levels) else "")


def difference(levels):
    """ "between its values the mean error differs by a factor of 2.0" """
    where = "parts of its range" if any(level.is_part for level in levels) else "its values"
    ratio = ratio_of(levels)
    by = f"a factor of {ratio:.1f}" if ratio >= SMALL else "less than 5 %"
    return f"between {where} {mean_text(levels)} differs by {by}"


def about_one(factor, levels, matters):
    """What the factor that matters most does."""
    rest = [level for level in levels if math.isfinite(level.mean)]
    lost = [level for level in levels if math.isinf(level.mean)]
    name = parts_of(factor.label)[0]
    if not lost:
        return [f"{name} {matters}: {difference(rest)}."]
    said = [f"{name} {matters}: " + ", ".join(map(of_runs, lost))
            + ", and no setting with it ended well on all recordings."]
    if len(rest) > 1:
        said += [difference(rest).replace("between its", "Between its other", 1) + "."]
    return said


def about_means(findings, found):
    """The factor whose values differ most in their mean error. Only of factors that have such a mean,
    and of "most" only where all of the design can be compared."""
    judged = {name: levels for name, levels in found.items()
              if len(levels) > 1 and any(math.isfinite(level.mean) for level in levels)}
    whole = len(judged) == len(found) and all(point.name in findings.scores
                                              for point in findings.study.points if point.in_design)
    if findings.sampled and judged:
        judged = {name: levels for name, levels in judged.items()
                  if chance(findings, findings.study.factor(name)) < CHANCE / len(found)}
        if not judged:
            count = len({row["point"] for row in findings.design} & {*findings.scores})
            return [f"From {names.counted(count, 'sample')} it cannot be told which factor matters: "
                    "between the values of each, errors differ no more than they might by chance."]
    if not judged:
        return []
    most = max(judged, key=lambda name: ratio_of(judged[name]))
    if ratio_of(judged[most]) < SMALL and not findings.sampled:
        every = [level for levels in judged.values() for level in levels]
        return [f"No factor by itself changes {mean_text(every)} by more than 5 %."] if whole else []
    return about_one(findings.study.factor(most), judged[most],
                     "matters most" if whole and len(found) > 1 else "matters")


def about_failing_values(found, said):
    """The value with which most runs failed, unless that was said."""
    several = [levels for levels in found.values() if len(levels) > 1]
    if not several:
        return []
    worst, least = max((sorted(levels, key=lambda level: -level.lost)[::len(levels) - 1]
                        for levels in several), key=lambda ends: ends[0].lost - ends[1].lost)
    if worst.lost == least.lost or any(of_runs(worst) in text for text in said):
        return []
    return [f"{of_runs(worst)}, {least.failed} of {least.runs} with {least.text}."]


def about_factors(findings):
    """The factor whose values differ most in their mean error, and the value that fails most."""
    found = {factor.name: levels_of(findings, factor) for factor in findings.study.factors
             if len(findings.bins(factor)) > 1}
    said = about_means(findings, found)
    return said + about_failing_values(found, said)
