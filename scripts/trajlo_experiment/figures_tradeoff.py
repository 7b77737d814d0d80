# SPDX-License-Identifier: MIT
"""Error against processor time, with the settings that nothing beats in both."""
import math

import numpy as np
from matplotlib.lines import Line2D

from trajlo_experiment import analysis
from trajlo_experiment.drawing import (below, draw_marks, error_axis, mark_handles,
                                       open_frame)
from trajlo_experiment.figures_sensitivity import panels
from trajlo_report import names, theme
from trajlo_report.log_axis import plain_log

COST, COST_LABEL = "cpu_ms_per_data_second", "processor time [ms per s of data]"


def tradeoff(findings, group):
    """Points with their median cost and error on a scenario, and which of them are its front."""
    points = {}
    for row in findings.rows:
        if row["group"] == group:
            points.setdefault(row["point"], []).append(row)
    settings = list(points)
    costs = [analysis.median([row[COST] for row in points[name] if row[COST]])
             for name in settings]
    errors = [analysis.median(findings.errors(points[name])) for name in settings]
    usable = [i for i, pair in enumerate(zip(costs, errors)) if all(map(math.isfinite, pair))]
    front = analysis.pareto([costs[i] for i in usable], [errors[i] for i in usable])
    return settings, costs, errors, [usable[i] for i in front]


def draw_pareto(findings):
    """A panel for each scenario that has a front; the numbers lead to the table of the page."""
    found = {group: tradeoff(findings, group) for group in findings.groups}
    found = {group: values for group, values in found.items() if values[-1]}
    if not found:
        return None
    figure, grid = panels(len(found), 2.4)
    for axes, (group, values) in zip(grid, found.items()):
        draw_front(axes, findings, *values)
        axes.set_title(names.title(group))
        axes.set_xlabel(COST_LABEL)
    for axes in grid[::3]:
        axes.set_ylabel(findings.label)
    handles = [Line2D([], [], ls="", marker="o", ms=3, color=theme.STAGES["segment"], alpha=0.7,
                      label="a setting, median over seeds"),
               Line2D([], [], marker="o", ms=4, lw=1, color=theme.METHODS[0],
                      label="nothing is better in both")]
    if any(math.isinf(error) for _, _, errors, _ in found.values() for error in errors):
        handles.append(Line2D([], [], ls="", marker="x", ms=4, color=theme.END, label="fails"))
    below(figure, handles + mark_handles(findings, findings.marks))
    return figure


def draw_front(axes, findings, settings, costs, errors, front):
    costs, errors = np.array(costs), np.array(errors)
    good = np.isfinite(costs) & np.isfinite(errors)
    axes.plot(costs[good], errors[good], "o", ms=2.6, mew=0, color=theme.STAGES["segment"],
              alpha=0.7)
    error_axis(axes, errors[good])
    lost = np.isinf(errors) & np.isfinite(costs)
    if lost.any():  # a line without points would take part in the layout
        axes.plot(costs[lost], np.full(lost.sum(), 0.98), "x", ms=3.5, color=theme.END,
                  clip_on=False, transform=axes.get_xaxis_transform())
    axes.step(costs[front], errors[front], where="post", color=theme.METHODS[0], lw=1)
    axes.plot(costs[front], errors[front], "o", ms=4, color=theme.METHODS[0])
    for number, index in enumerate(front, 1):
        axes.annotate(str(number), (costs[index], errors[index]), textcoords="offset points",
                      xytext=(-3, -6), ha="right", va="center", fontsize=6,
                      color=theme.METHODS[0]).set_in_layout(False)
    places = {name: settings.index(row["point"]) for name, row in findings.marks.items()
              if row["point"] in settings}
    draw_marks(axes, findings, {name: (costs[index], errors[index])
                                for name, index in places.items() if good[index]})
    axes.set_xscale("log")
    finite = costs[np.isfinite(costs)]
    axes.set_xlim(finite.min() / 1.12, finite.max() * 1.12)
    plain_log(axes.xaxis, *axes.get_xlim())
    open_frame(axes)
