# SPDX-License-Identifier: MIT
"""What an experiment found, in sentences, and what to be careful about."""
import yaml

from trajlo_experiment import analysis, effects
from trajlo_experiment.factors import level_of
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


def about_best(findings, ranked):
    """The best setting, and how it compares with what the errors are relative to."""
    row_of = {row["point"]: row for row in findings.rows}
    best = ranked[0]
    if best.failed:
        return [f"No setting ended well on all {other(findings)}recordings."]
    said = [which_is_best(findings, ranked)]
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


def about_failures(findings, ranked):
    failing = sum(item.failed > 0 for item in ranked)
    if not failing or ranked[0].failed:  # then that was said of all of them
        return []
    return [f"{failing} of {len(ranked)} settings failed on at least one "
            f"{other(findings)}recording."]


def other(findings):
    """ "other " where recordings are left out."""
    return "other " if findings.left_out else ""


def recording_title(recording):
    group, seed = recording
    return names.title(f"{group}-seed{seed}" if seed else group)


def about_left_out(findings):
    """Recordings that tell nothing about settings, since no run has an error on them."""
    no_metric = f"no run that ended well has {findings.metric}"
    if findings.left_out and not findings.rows:
        why = "no run has ended well" if all(findings.left_out.values()) else no_metric
        return [f"Settings are not compared: {why}."]
    said = []
    for have_failed, why in ((True, "no run has ended well"), (False, no_metric)):
        found = [recording for recording, failed in findings.left_out.items() if failed == have_failed]
        if found:
            said.append(f"On {names.counted(len(found), 'recording')} {why}, and what follows leaves "
                        f"{'it' if len(found) == 1 else 'them'} out: "
                        f"{'; '.join(map(recording_title, found))}.")
    return said


def about_unranked(findings, ranked):
    """Settings that are not compared."""
    count = len(findings.study.points)
    if len(ranked) == count or not findings.rows:
        return []
    where, yet = f"on all {other(findings)}recordings", "" if findings.has_ended else " yet"
    if not ranked:
        what = f"has {findings.metric}" if findings.has_ended else "has ended"
        return [f"No setting {what} {where}{yet}."]
    rest = count - len(ranked)
    what = f"no {findings.metric}" if findings.has_ended else "not ended"
    said = "is not compared: it has" if rest == 1 else "are not compared: they have"
    return [f"{rest} of {count} settings {said} {what} {where}{yet}."]


def sentences(findings):
    ranked, said = findings.ranked(), about_left_out(findings)
    if ranked:
        said += [*about_best(findings, ranked), *effects.without_effect(findings, ranked),
                 *effects.about_factors(findings), *about_failures(findings, ranked)]
    return said + about_unranked(findings, ranked)


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
    if not findings.reference.errors:
        return ""
    if not findings.has_intervals:
        return ("There are too few seeds to tell how far results would scatter with others. So no "
                "intervals are given, and small differences may be chance.")
    groups = [group for group, _ in findings.reference.errors]
    seeds = min(map(groups.count, groups))
    return f"With {names.counted(seeds, 'seed')} per scenario the intervals are rough." if seeds < 5 else ""
