# SPDX-License-Identifier: MIT
"""What an experiment found, in sentences, and what to be careful about."""
import math
import re

import numpy as np
import yaml

from trajlo_experiment import analysis
from trajlo_experiment.findings import level_text


def setting_text(findings, row):
    return ", ".join(level_of(factor, row[factor.name]) for factor in findings.study.factors
                     if row[factor.name] is not None)


def level_of(factor, level):
    """ "σ = 0.1 m" of the label "σ [m]" """
    label = re.fullmatch(r"(.+) \[(.+)\]", factor.label)
    name, unit = label.groups() if label else (factor.label, "")
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


def about_best(findings, ranked):
    """The best setting, and how it compares with what the errors are relative to."""
    row_of = {row["point"]: row for row in findings.rows}
    best = ranked[0]
    said = [f"The best of {len(ranked)} settings is {setting_text(findings, row_of[best.point])}."]
    if best.failed:
        none = "No setting ended well on all recordings."
        return [none, *said, f"It failed {best.failed} times."] if math.isfinite(best.score) else [
            none]
    marks = analysis.marks_of(row_of[best.point])
    reference = findings.study.reference
    if not findings.exact_reference:
        return said
    if reference in marks:
        return [f"{said[0]} That is “{reference}”."]
    place = next((place for place, item in enumerate(ranked, 1)
                  if reference in analysis.marks_of(row_of[item.point])), None)
    which = f", which is number {place}" if place else ""
    return [*said, f"Its error is {change(best.score)} that of “{reference}”{which}"
            f"{scatter(findings, best)}."]


def about_factors(findings):
    """The factor whose values differ most, by the geometric mean over all that ended well."""
    swings = {}
    for factor in findings.study.factors:
        levels, bins = [], findings.bins(factor)
        if findings.sampled and all(len({row["point"] for row in item.rows}) < 2 for item in bins):
            continue  # Each level is one sample, in which all factors differ.
        for item in bins:
            scores = {row["point"]: findings.scores[row["point"]].score for row in item.rows
                      if row["point"] in findings.scores}
            finite = [score for score in scores.values() if math.isfinite(score)]
            levels += [float(np.exp(np.mean(np.log(finite))))] if finite else []
        if len(levels) > 1:
            swings[factor.label] = max(levels) / min(levels)
    if not swings:
        return []
    most = max(swings, key=swings.get)
    if swings[most] < 1.05:
        return ["No factor by itself changes the mean error by more than 5 %."]
    return [f"{most} matters most: between its values the mean error differs by a factor of "
            f"{swings[most]:.1f}."]


def about_failures(findings, ranked):
    failing = sum(item.failed > 0 for item in ranked)
    if not failing:
        return []
    return [f"{failing} of {len(ranked)} settings failed on at least one recording."]


def sentences(findings):
    ranked = findings.ranked()
    if not ranked:
        return ["No setting has ended on all recordings yet."] if findings.rows else []
    return [*about_best(findings, ranked), *about_factors(findings),
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
    if densities and not asked and any(map(tunes_itself, {run.options for run in plan.runs})):
        said.append(f"{', '.join(densities)} varied while motion_prior.self_tuning was true: the "
                    "runs set these by themselves, and what was varied is only where they began. "
                    "Set motion_prior.self_tuning: false to compare densities.")
    return said


def caution(findings):
    """What the seeds are worth."""
    seeds = analysis.fewest_seeds(analysis.recordings_of(findings.rows))
    if seeds < 2:
        return ("Some scenarios have one seed only. Nothing tells how far results would scatter "
                "with others, so no intervals are given, and small differences may be chance.")
    return f"With {seeds} seeds per scenario the intervals are rough." if seeds < 5 else ""
