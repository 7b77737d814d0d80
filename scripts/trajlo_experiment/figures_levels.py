# SPDX-License-Identifier: MIT
"""A factor whose levels are names: error and time, a line for each name."""
import math

from matplotlib import pyplot as plt
from matplotlib.lines import Line2D
from matplotlib.patheffects import withStroke

from trajlo_experiment.drawing import SHAPES, below, open_frame
from trajlo_experiment.figures_sensitivity import quartiles
from trajlo_experiment.figures_tradeoff import COST, COST_LABEL
from trajlo_report import names, theme
from trajlo_report.log_axis import plain_log


def draw_quartiles(axes, findings, bins, values_of):
    """Median and quartiles of each bin and scenario; values_of(rows, group) are numbers."""
    finite, count = [], len(findings.groups)
    for index, group in enumerate(findings.groups):
        look = {"color": theme.method_style(index)["color"], "marker": SHAPES[index % 6]}
        for place, item in enumerate(bins):
            values = values_of(item.rows, group)
            low, middle, high = quartiles(values)
            at = place + (index - (count - 1) / 2) * 0.75 / max(count, 2)
            finite += [value for value in (low, middle, high) if math.isfinite(value)]
            if math.isfinite(low):
                # A quartile among the failures is beyond the axis.
                axes.plot([low, high if math.isfinite(high) else 1e9], [at, at], lw=1.6, alpha=0.4,
                          color=look["color"], solid_capstyle="butt")
            axes.plot(middle, at, ms=3.5, **look)
            failed = sum(map(math.isinf, values))
            if failed:
                axes.text(1.0, at, f"× {failed} of {len(values)}", fontsize=5.5, va="center",
                          ha="right", color=look["color"], transform=axes.get_yaxis_transform(),
                          path_effects=[withStroke(linewidth=2, foreground=theme.PANEL)])
        axes.plot([], [], ms=3.5, ls="", label=names.title(group), **look)
    if finite and min(finite) > 0:
        span = max(math.log10(max(finite) / min(finite)), 0.3)
        axes.set_xscale("log")
        # Failures are told at the right.
        right = 0.3 if findings.failures else 0.08
        axes.set_xlim(min(finite) / 10 ** (0.08 * span), max(finite) * 10 ** (right * span))
        plain_log(axes.xaxis, *axes.get_xlim())


def draw_levels(findings, factor):
    bins = findings.bins(factor)
    height = len(bins) * (0.1 + 0.09 * len(findings.groups)) + 0.5
    figure, grid = plt.subplots(1, 2, sharey=True, figsize=(theme.PAGE_IN, height),
                                constrained_layout=True, gridspec_kw={"width_ratios": [3, 2]})
    draw_quartiles(grid[0], findings, bins, findings.errors)
    draw_quartiles(grid[1], findings, bins, lambda rows, group: [
        row[COST] for row in rows if row["group"] == group and row[COST]])
    grid[0].set_yticks(range(len(bins)), [item.label for item in bins])
    grid[0].set(xlabel=findings.label, ylim=(len(bins) - 0.45, -0.55))
    grid[1].set(xlabel=COST_LABEL)
    for axes in grid:
        axes.grid(axis="y", visible=False)
        for place in range(1, len(bins)):
            axes.axhline(place - 0.5, color=theme.GRID, lw=0.5)
        open_frame(axes)
    below(figure, [*grid[0].get_legend_handles_labels()[0],
                   Line2D([], [], color=theme.TEXT, lw=1.6, alpha=0.4, label="quartiles")])
    return figure
