# SPDX-License-Identifier: MIT
"""What an experiment found, in sentences, and what to be careful about."""
import dataclasses
import math
import re

import numpy as np
import yaml

from trajlo_experiment import analysis
from trajlo_experiment.findings import level_text
from trajlo_report import names


LISTED = 3  # of settings that tie


def other_options(findings, point):
    """What a setting sets besides the levels of factors, or otherwise than these: {option: text}."""
    of_factors = {}
    for name, level in point.levels.items():
        of_factors.update(findings.study.factor(name).options(level))
    return {key: text for key, text in point.settings.items() if of_factors.get(key) != text}


def setting_text(findings, row):
    """The names of a setting but that of the reference, its values, and its other options."""
    point = next(point for point in findings.study.points if point.name == row["point"])
    values = [level_of(factor, row[factor.name]) for factor in findings.study.factors
              if row[factor.name] is not None]
    values += [f"{key} = {text}" for key, text in other_options(findings, point).items()]
    marks = [f"“{mark}”" for mark in analysis.marks_of(row) if mark != findings.study.reference]
    return ": ".join(text for text in (", ".join(marks), ", ".join(values)) if text)


def parts_of(label):
    """ "σ", "m" of the label "σ [m]" """
    parts = re.fullmatch(r"(.+) \[(.+)\]", label)
    return parts.groups() if parts else (label, "")


def level_of(factor, level):
    """ "σ = 0.1 m" of the label "σ [m]" """
    name, unit = parts_of(factor.label)
    return f"{name} = {level_text(level)} {unit}".rstrip()


def change(score):
    """An error relative to another, in words."""
    if abs(score - 1.0) < 0.005:
        return "as high as"
    if score < 1.0:
        return f"{100 * (1 - score):.0f} % lower than"
    return f"{100 * (score - 1):.0f} % higher than" if score < 2 else f"{score:.1f} × as high as"


def scatter(findings, best):
    if not findings.has_intervals:
        return ""
    text = f" (95 % interval: {best.low:.2f} to {best.high:.2f} times as high)"
    if best.low <= 1.0 <= best.high:
        text += "; other seeds might well turn that around"
    return text


def best_of(ranked):
    """The best setting, and those that are as good."""
    return [item for item in ranked if item is ranked[0] or analysis.is_tie(ranked[0], item)]


def which_is_best(findings, ranked):
    row_of = {row["point"]: row for row in findings.rows}
    tied, best = best_of(ranked), ranked[0]
    if len(tied) < 2:
        return f"The best of {len(ranked)} settings is {setting_text(findings, row_of[best.point])}."
    listed = [f"({setting_text(findings, row_of[item.point])})" for item in tied[:LISTED]]
    more = f" and {len(tied) - LISTED} more" if len(tied) > LISTED else ""
    why = ("they gave exactly the same results"
           if all(analysis.same_results(best, item) for item in tied)
           else "their errors differ by less than seeds scatter, or than is printed")
    return (f"None of {len(ranked)} settings is the best: {len(tied)} tie, {', '.join(listed)}{more}; "
            f"{why}.")


def without_effect(findings, ranked):
    """Factors whose settings, where nothing else differs, have the same errors on every run."""
    levels = {point.name: point.levels for point in findings.study.points if point.in_design}
    said = []
    for factor in findings.study.factors:
        alike = {}
        for item in ranked:
            if factor.name in levels.get(item.point, {}):
                others = sorted((name, str(level)) for name, level in levels[item.point].items()
                                if name != factor.name)
                alike.setdefault(str(others), []).append(item)
        compared = [items for items in alike.values() if len(items) > 1]
        if compared and all(analysis.same_results(items[0], item)
                            for items in compared for item in items):
            said.append(f"{parts_of(factor.label)[0]} has no effect here: settings that differ in it "
                        "alone gave exactly the same results.")
    return said


def about_best(findings, ranked):
    """The best setting, and how it compares with what the errors are relative to."""
    row_of = {row["point"]: row for row in findings.rows}
    best = ranked[0]
    said = [which_is_best(findings, ranked)]
    if best.failed:
        none = "No setting ended well on all recordings."
        return [none, *said, f"It failed {best.failed} times."] if math.isfinite(best.score) else [
            none]
    marks = analysis.marks_of(row_of[best.point])
    reference = findings.study.reference
    if not findings.reference.is_marked:
        return said
    if len(best_of(ranked)) > 1 and any(reference in analysis.marks_of(row_of[item.point])
                                        for item in best_of(ranked)):
        return [f"{said[0]} “{reference}” is among them."]
    if reference in marks:
        return [f"{said[0]} That is “{reference}”."]
    place = next((place for place, item in enumerate(ranked, 1)
                  if reference in analysis.marks_of(row_of[item.point])), None)
    which = f", which is number {place}" if place else ""
    where = findings.compared_text and f"{findings.compared_text},"
    whose = "The error of the first of them" if len(best_of(ranked)) > 1 else "Its error"
    return [*said, f"{whose}{where} is {change(best.score)} that of "
            f"“{reference}”{which}{scatter(findings, best)}."]


@dataclasses.dataclass(frozen=True)
class Level:
    """What all runs with one value of a factor say together."""
    text: str      # "σ = 0.1 m"
    mean: float    # geometric, of the settings that ended well everywhere; infinite if none did
    failed: int
    runs: int

    @property
    def lost(self):
        return self.failed / self.runs


def levels_of(findings, factor):
    bins = findings.bins(factor)
    if findings.sampled and all(len({row["point"] for row in item.rows}) < 2 for item in bins):
        return []  # Each level is one sample, in which all factors differ.
    found = []
    for item in bins:
        scores = [findings.scores[name].score for name in {row["point"] for row in item.rows}
                  if name in findings.scores]
        finite = [score for score in scores if math.isfinite(score)]
        failed = [math.isinf(error) for error in findings.errors(item.rows)]
        if scores:
            mean = float(np.exp(np.mean(np.log(finite)))) if finite else math.inf
            found.append(Level(level_of(factor, item.label), mean, sum(failed), len(failed)))
    return found


def ratio_of(levels):
    """Between the means of the worst and the best; a value with which no setting ended well is worse
    than any other."""
    means = [level.mean for level in levels]
    return max(means) / min(means) if math.isfinite(min(means, default=math.inf)) else 1.0


def of_runs(level):
    return f"{level.failed} of {names.counted(level.runs, 'run')} failed with {level.text}"


def about_factors(findings):
    """The factor whose values differ most in their mean error, and the value that fails most."""
    found = {factor.label: levels_of(findings, factor) for factor in findings.study.factors}
    found = {label: levels for label, levels in found.items() if len(levels) > 1}
    if not found:
        return []
    most = max(found, key=lambda label: ratio_of(found[label]))
    rest = [level for level in found[most] if math.isfinite(level.mean)]
    lost = [level for level in found[most] if math.isinf(level.mean)] if rest else []
    if lost:
        said = [f"{parts_of(most)[0]} matters most: " + ", ".join(map(of_runs, lost))
                + ", and no setting with it ended well on all recordings."]
        if len(rest) > 1:
            said += [f"Between its other values the mean error differs by a factor of "
                     f"{ratio_of(rest):.1f}."]
    elif ratio_of(rest) >= 1.05:
        said = [f"{parts_of(most)[0]} matters most: between its values the mean error differs by a factor of "
                f"{ratio_of(rest):.1f}."]
    else:
        said = ["No factor by itself changes the mean error by more than 5 %."]
    worst, least = max((sorted(levels, key=lambda level: -level.lost)[::len(levels) - 1]
                        for levels in found.values()), key=lambda ends: ends[0].lost - ends[1].lost)
    if worst.lost > least.lost and worst not in lost:
        said += [f"{of_runs(worst)}, {least.failed} of {least.runs} with {least.text}."]
    return said


def about_failures(findings, ranked):
    failing = sum(item.failed > 0 for item in ranked)
    if not failing:
        return []
    return [f"{failing} of {len(ranked)} settings failed on at least one recording."]


def sentences(findings):
    ranked = findings.ranked()
    if not ranked:
        return ["No setting has ended on all recordings yet."] if findings.rows else []
    return [*about_best(findings, ranked), *without_effect(findings, ranked), *about_factors(findings),
            *about_failures(findings, ranked)]


def tunes_itself(options):
    """Whether a run with these options sets the densities of the motion prior by itself."""
    prior = (yaml.safe_load(options) or {}).get("motion_prior")
    return isinstance(prior, dict) and prior.get("self_tuning") is True


def warnings(plan):
    """What makes an experiment mean less than it seems to."""
    said = []
    varied = {key for factor in plan.suite.factors for key in
              [*factor.keys, *(key for options in factor.settings.values() for key in options)]}
    densities = sorted(key for key in varied
                       if key in ("expert.motion_prior.translation_m2_s3", "expert.motion_prior.rotation_rad2_s3"))
    asked = "motion_prior.self_tuning" in varied  # then it is what the experiment is about
    # A mark may well tune itself beside a sweep that does not.
    design = {point.name for point in plan.suite.points if point.in_design}
    options = {run.options for run in plan.runs if run.configuration.name in design}
    if densities and not asked and any(map(tunes_itself, options)):
        said.append(f"This is a sweep of {', '.join(densities)} while motion_prior.self_tuning is "
                    "true: the runs set these by themselves, and what varies is only where they "
                    "begin. Set motion_prior.self_tuning: false to compare densities.")
    return said


def caution(findings):
    """What the seeds are worth."""
    if not findings.has_intervals:
        return ("There are too few seeds to tell how far results would scatter with others. So no "
                "intervals are given, and small differences may be chance.")
    groups = [group for group, _ in findings.reference.errors]
    seeds = min(map(groups.count, groups))
    return f"With {names.counted(seeds, 'seed')} per scenario the intervals are rough." if seeds < 5 else ""
