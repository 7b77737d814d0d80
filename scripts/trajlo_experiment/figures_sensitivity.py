# SPDX-License-Identifier: MIT
"""What each factor does by itself: errors and failures over its levels."""
import math

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from trajlo_experiment import analysis, designs
from trajlo_experiment.drawing import (SHAPES, below, draw_marks, error_axis, factor_axis,
                                       mark_handles, open_frame)
from trajlo_experiment.experiment import CENTER
from trajlo_experiment.factors import is_number
from trajlo_report import names, theme

PER_LINE = 3


def quartiles(errors):
    return [analysis.quantile(errors, share) for share in (0.25, 0.5, 0.75)]


def panels(count, height_in=2.1, per_line=PER_LINE, sharey=False):
    lines = math.ceil(count / per_line)
    columns = min(count, per_line)
    width = theme.PAGE_IN * (columns / per_line if columns < per_line else 1.0)
    figure, grid = plt.subplots(lines, columns, squeeze=False, sharey=sharey,
                                figsize=(max(width, theme.COLUMN_IN), height_in * lines),
                                constrained_layout=True)
    for axes in grid.flat[count:]:
        axes.set_axis_off()
    return figure, list(grid.flat[:count])


def failure_marks(axes, place, failed, index, color):
    """Above everything: a cross with the number of runs that failed."""
    height = 0.985 - 0.06 * index
    axes.plot(place, height, "x", transform=axes.get_xaxis_transform(), color=color, ms=3.5,
              mew=1.0, clip_on=False)
    axes.annotate(str(failed), (place, height), xycoords=axes.get_xaxis_transform(),
                  textcoords="offset points", xytext=(4, 0), va="center", fontsize=5,
                  color=color).set_in_layout(False)


def draw_factor(axes, findings, factor):
    """Median and quartiles over everything else, a line for each scenario."""
    bins = findings.bins(factor)
    centers = np.array([item.center for item in bins], dtype=float)
    everything, best_lines = [], findings.study.design.kind == designs.GRID
    for index, group in enumerate(findings.groups):
        style = theme.method_style(index)
        spread = np.array([quartiles(findings.errors(item.rows, group)) for item in bins])
        finite = np.where(np.isfinite(spread), spread, np.nan)
        everything += list(finite.flat)
        # A quartile among the failures is beyond the axis.
        top = np.where(np.isinf(spread[:, 2]), 1e9, finite[:, 2])
        axes.fill_between(centers, finite[:, 0], top, color=style["color"], alpha=0.15, lw=0)
        axes.plot(centers, finite[:, 1], marker="o", ms=2.8, **style)
        if best_lines and len(findings.study.factors) > 1:
            best = [min(point_medians(findings, item.rows, group), default=math.nan)
                    for item in bins]
            everything += best
            axes.plot(centers, best, lw=0.7, color=style["color"], ls=(0, (1, 1.2)))
        for item in bins:
            errors = findings.errors(item.rows, group)
            if any(map(math.isinf, errors)):
                failure_marks(axes, item.center, sum(map(math.isinf, errors)), index,
                              style["color"])
    error_axis(axes, everything)
    factor_axis(axes, factor, centers)
    open_frame(axes)
    draw_marks(axes, findings, {name: (row[factor.name], 0.0) for name, row in findings.marks.items()
                                if is_number(row[factor.name]) and name != CENTER},
               transform=axes.get_xaxis_transform(), clip_on=False)


def point_medians(findings, rows, group):
    """The median over seeds of each setting."""
    points = {}
    for row in rows:
        if row["group"] == group:
            points.setdefault(row["point"], []).append(findings.error(row))
    return [analysis.median(errors) for errors in points.values()]


def draw_sensitivity(findings):
    """A panel for each numeric factor."""
    factors = [factor for factor in findings.study.factors
               if factor.numeric and len(findings.bins(factor)) > 1]
    if not factors:
        return None
    figure, grid = panels(len(factors))
    for axes, factor in zip(grid, factors):
        draw_factor(axes, findings, factor)
    for axes in grid[::PER_LINE]:
        axes.set_ylabel(findings.label)
    handles = scenario_handles(findings)
    handles.append(Patch(color=theme.TEXT, alpha=0.15, lw=0, label="quartiles"))
    if findings.study.design.kind == designs.GRID and len(findings.study.factors) > 1:
        handles.append(Line2D([], [], color=theme.TEXT, lw=0.7, ls=(0, (1, 1.2)),
                              label="best of the other factors"))
    marked = [name for name, row in findings.marks.items() if name != CENTER
              and any(is_number(row[factor.name]) for factor in factors)]
    below(figure, handles + mark_handles(findings, marked))
    return figure


def scenario_handles(findings):
    handles = [Line2D([], [], marker="o", ms=3, label=names.title(group),
                      **theme.method_style(index))
               for index, group in enumerate(findings.groups)]
    if findings.failures:
        handles.append(Line2D([], [], ls="", marker="x", ms=4, mew=1.0, color=theme.TEXT,
                              label="number of failures"))
    return handles


def draw_failures(findings):
    """The share of runs that failed by level, with its 95 % interval; nothing if none failed."""
    factors = [factor for factor in findings.study.factors if len(findings.bins(factor)) > 1]
    if not findings.failures or not factors:
        return None
    crowded = max(len(findings.bins(factor)) for factor in factors) > 6
    per_line = 1 if crowded else PER_LINE
    figure, grid = panels(len(factors), 2.4 if crowded else 1.9, per_line, sharey=True)
    for axes, factor in zip(grid, factors):
        bins = findings.bins(factor)
        for place, item in enumerate(bins):
            failed = [math.isinf(error) for error in findings.errors(item.rows)]
            rate, (low, high) = np.mean(failed), analysis.wilson(sum(failed), len(failed))
            axes.bar(place, 100 * rate, 0.62, color=theme.GRID)
            if len(failed) > 1:
                axes.plot([place, place], [100 * low, 100 * high], color=theme.TEXT, lw=0.8)
            for index, group in enumerate(findings.groups):
                own = [math.isinf(error) for error in findings.errors(item.rows, group)]
                at = place + (index - (len(findings.groups) - 1) / 2) * 0.13
                if own:
                    axes.plot(at, 100 * np.mean(own), SHAPES[index % 6], ms=3,
                              color=theme.method_style(index)["color"])
        texts = [item.label for item in bins]
        long = max(map(len, texts)) > 7
        axes.set_xticks(range(len(bins)), texts, rotation=35 if long else 0,
                        ha="right" if long else "center", rotation_mode="anchor" if long else None)
        axes.set_xlabel(factor.label)
        axes.set_ylim(bottom=-2)
        axes.grid(axis="x", visible=False)
        open_frame(axes)
    for axes in grid[::per_line]:
        axes.set_ylabel("failed runs [%]")
    handles = [Line2D([], [], ls="", marker=SHAPES[index % 6], ms=4, label=names.title(group),
                      color=theme.method_style(index)["color"])
               for index, group in enumerate(findings.groups)]
    handles += [Patch(color=theme.GRID, label="all scenarios"),
                Line2D([], [], color=theme.TEXT, lw=0.8, label="95 % interval")]
    below(figure, handles)
    return figure
