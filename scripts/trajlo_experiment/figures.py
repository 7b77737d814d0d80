# SPDX-License-Identifier: MIT
"""All figures of an experiment: which there are, and what is said below them."""
import re

from trajlo_experiment import (analysis, designs, figures_heat, figures_levels, figures_parallel,
                               figures_sensitivity, figures_tornado, figures_tradeoff)
from trajlo_report import files, theme

MOST_ROWS = 4  # levels of a third factor that get a line of panels each


def longest(findings, factor):
    return max(len(item.label) for item in findings.bins(factor))


def heat_maps(findings):
    """What the experiment asks for; else the first two factors, and a third with few levels."""
    study = findings.study
    if study.heat_maps:
        return [tuple(map(study.experiment.factor, names)) for names in study.heat_maps]
    factors = [factor for factor in study.factors if len(findings.bins(factor)) > 1]
    if study.design.kind == designs.ONE_AT_A_TIME or len(factors) < 2:
        return []
    if longest(findings, factors[0]) > longest(findings, factors[1]):
        factors[:2] = factors[1::-1]  # long names have their place at the side
    third = factors[2:] if len(factors) == 3 and len(findings.bins(factors[2])) <= MOST_ROWS else []
    return [tuple([*factors[:2], *third])]


def map_figures(findings):
    """Name, figure, caption."""
    # So far all that ended may lie beside the design.
    shown = [factors for factors in heat_maps(findings) if all(map(findings.bins, factors))]
    for index, factors in enumerate(shown):
        name = "heat_map" if index == 0 else f"heat_map_{index + 1}"
        across, upwards = factors[:2]
        if findings.sampled:
            if across.numeric and upwards.numeric:
                yield name, figures_heat.draw_scatter_map(findings, across, upwards), (
                    "Each point is a setting; its colour is its error over all scenarios.")
            continue
        rows = factors[2] if len(factors) == 3 else None
        rest = [factor for factor in findings.study.factors if factor not in factors]
        over = "seeds" if not rest else "seeds and " + ", ".join(factor.label for factor in rest)
        yield name, figures_heat.draw_heat_map(findings, across, upwards, rows), (
            f"Median {findings.label} over {over}; the frame is around the best of a panel, the "
            "colour says how much worse a cell is than the best of its scenario. A hatched cell "
            "with × failed in half of its runs or more; a number before × says how many failed. "
            "The last column is the geometric mean of the colours.")


def all_figures(findings):
    """Name, figure or nothing, caption; none where there is nothing to compare."""
    if not findings.rows:
        return
    kind = findings.study.design.kind
    if kind == designs.ONE_AT_A_TIME:
        yield "tornado", figures_tornado.draw_tornado(findings), (
            "How far each factor alone moves the error away from that of the centre: its best and "
            "its worst value, or each of its names.")
    yield from map_figures(findings)
    about = ("about the centre" if kind == designs.ONE_AT_A_TIME else
             "over seeds and all other factors")
    values = "each part of the range" if findings.sampled else "each value"
    yield "sensitivity", figures_sensitivity.draw_sensitivity(findings), (
        f"Median and quartiles {about} for {values} of a factor. A failed run counts as an "
        "infinite error; × says how many failed.")
    for factor in findings.study.factors:
        if not factor.numeric and len(findings.bins(factor)) > 1:
            name = re.sub(r"\W+", "_", factor.name)
            yield f"levels_{name}", figures_levels.draw_levels(findings, factor), (
                f"Median and quartiles {about} of error and processor time: {factor.label}.")
    yield "failures", figures_sensitivity.draw_failures(findings), (
        "Share of the runs that got lost, diverged or crashed.")
    yield "pareto", figures_tradeoff.draw_pareto(findings), (
        "Error against processor time of the whole program; the numbers lead to the table. Times that "
        f"differ by less than {100 * analysis.COST_NOISE:.0f} % count as equal: that much is noise.")
    if kind != designs.ONE_AT_A_TIME:
        yield "parallel", figures_parallel.draw_parallel(findings), (
            "Each line is a setting, from its values to its error over all scenarios.")


def draw_all(findings, folder):
    """Writes all figures; returns those of the page with captions and widths."""
    files.make_folder(folder)
    theme.apply()
    drawn = []
    for name, figure, caption in all_figures(findings):
        if figure is None:
            for kind in theme.FORMATS:  # of an earlier state, in which something had failed
                (folder / f"{name}.{kind}").unlink(missing_ok=True)
            continue
        width = int(140 * figure.get_size_inches()[0])
        paths = theme.save(figure, folder / name)
        drawn.append({"path": paths[0], "caption": caption, "width": width})
    return drawn
