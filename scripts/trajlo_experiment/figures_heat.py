# SPDX-License-Identifier: MIT
"""Maps of the error over two factors, one for each scenario and one for all of them together."""
import math

import matplotlib
import numpy as np
from matplotlib import pyplot as plt
from matplotlib.colors import LogNorm
from matplotlib.lines import Line2D

from trajlo_experiment import analysis
from trajlo_experiment.drawing import below, draw_marks, mark_handles, soften
from trajlo_experiment.factors import LOG, level_text
from trajlo_experiment.findings import place_among
from trajlo_report import names, theme
from trajlo_report.log_axis import plain_log

ALL = "all scenarios"
WORST = 10.0  # cells this many times worse than the best look alike
PER_LINE = 4


def cell_rows(rows, across, upwards, x, y):
    return [row for row in rows if row[across.name] == x and row[upwards.name] == y]


def cells(findings, rows, group, across, upwards, columns, lines):
    """Median error and number of failures over seeds and other factors, [upwards, across]."""
    values, failed = (np.full((len(lines), len(columns)), fill) for fill in (math.nan, 0))
    for i, y in enumerate(lines):
        for j, x in enumerate(columns):
            errors = findings.errors(cell_rows(rows, across, upwards, x, y), group)
            values[i, j] = analysis.median(errors)
            failed[i, j] = sum(math.isinf(error) for error in errors)
    return values, failed.astype(int)


def relative(values, best):
    """By how much a cell is worse than the best of its scenario."""
    return values / best if np.isfinite(best) else np.full_like(values, math.inf)


def together(panels):
    """Geometric mean over the scenarios of how much worse each is than its best."""
    with np.errstate(invalid="ignore"):
        return np.exp(np.mean(np.log(panels), axis=0))


def draw_cells(axes, ratios, texts, failed, norm):
    colors = matplotlib.colormaps[theme.ERROR_MAP]
    axes.imshow(np.ma.masked_invalid(ratios), cmap=colors, norm=norm, origin="lower",
                aspect="auto")
    for (i, j), ratio in np.ndenumerate(ratios):
        if math.isnan(ratio):
            continue
        if math.isinf(ratio):
            axes.add_patch(plt.Rectangle((j - 0.5, i - 0.5), 1, 1, facecolor=theme.GRID,
                                         edgecolor=theme.BACKGROUND, hatch="////", lw=0))
        red, green, blue, _ = colors(norm(min(ratio, WORST)))
        dark = 0.3 * red + 0.59 * green + 0.11 * blue < 0.5 and math.isfinite(ratio)
        text = texts[i, j] if math.isfinite(ratio) else "×"
        if failed[i, j] and math.isfinite(ratio):
            text += f"\n{failed[i, j]} ×"
        axes.text(j, i, text, ha="center", va="center", fontsize=6, linespacing=0.9,
                  color="white" if dark else "black")
    if np.isfinite(ratios).any():
        i, j = np.unravel_index(np.nanargmin(ratios), ratios.shape)
        axes.add_patch(plt.Rectangle((j - 0.47, i - 0.47), 0.94, 0.94, fill=False, lw=1.3,
                                     edgecolor=theme.TEXT))


def mark_cells(axes, findings, across, upwards, columns, lines, rows_factor, level):
    """Marked settings at their place, also between the cells."""
    places = {}
    for name, row in findings.marks.items():
        x = place_among(across, row[across.name], columns)
        y = place_among(upwards, row[upwards.name], lines)
        elsewhere = rows_factor is not None and row[rows_factor.name] != level
        if x is None or y is None or elsewhere:
            continue
        if x == int(x) and y == int(y):  # on a cell: beside its number
            x, y = x + 0.33, y + 0.3
        places[name] = (x, y)
    draw_marks(axes, findings, places)
    return places


def draw_heat_map(findings, across, upwards, rows_factor):
    """Panels of scenarios beside each other; with `rows_factor` a line of panels for each level."""
    rows = [row for row in findings.design
            if row[across.name] is not None and row[upwards.name] is not None]
    columns, lines = ([item.center for item in findings.bins(factor, rows)]
                      for factor in (across, upwards))
    levels = [item.center for item in findings.bins(rows_factor, rows)] if rows_factor else [None]
    several = len(findings.groups) > 1
    titles = findings.groups + ([ALL] if several else [])
    per_line = len(titles) if rows_factor else min(PER_LINE, len(titles))
    count = len(levels) if rows_factor else math.ceil(len(titles) / per_line)
    width = theme.PAGE_IN if per_line > 2 else theme.PAGE_IN * (per_line + 0.4) / 3.4
    height = (0.5 + 0.27 * len(lines)) * count + 0.55
    figure, grid = plt.subplots(count, per_line, figsize=(width, height), squeeze=False,
                                sharex=True, sharey=True, constrained_layout=True)
    norm = LogNorm(1.0, WORST)
    # One best for all levels of the rows: their panels are to be compared.
    by_level = {level: [row for row in rows if level is None or row[rows_factor.name] == level]
                for level in levels}
    found = {(level, group): cells(findings, by_level[level], group, across, upwards, columns,
                                   lines) for level in levels for group in findings.groups}
    best = {group: min((float(np.nanmin(values)) for (_, name), (values, _) in found.items()
                        if name == group and not np.isnan(values).all()), default=math.nan)
            for group in findings.groups}
    marked = []
    for index, level in enumerate(levels):
        panels = []
        for place, title in enumerate(titles):
            axes = grid[index][place] if rows_factor else grid[place // per_line][place % per_line]
            if title == ALL and several:
                ratios = together(np.array([panel for panel, _ in panels]))
                failed = sum(failures for _, failures in panels)
                texts = np.vectorize("{:.2f}".format)(ratios)
            else:
                values, failed = found[(level, title)]
                ratios = relative(values, best[title])
                texts = np.vectorize(findings.text)(values)
                panels.append((ratios, failed))
            draw_cells(axes, ratios, texts, failed, norm)
            marked += mark_cells(axes, findings, across, upwards, columns, lines, rows_factor,
                                 level)
            unit = "× best" if title == ALL and several else findings.unit
            shown = names.title(title)
            finish_panel(axes, f"{shown} [{unit}]" if unit else shown, index, rows_factor)
    label_axes(grid, across, upwards, columns, lines, rows_factor, levels)
    for axes in grid.flat[len(titles) * len(levels):]:
        axes.set_axis_off()
    bar = figure.colorbar(matplotlib.cm.ScalarMappable(norm, theme.ERROR_MAP), ax=grid,
                          extend="max", shrink=0.9, pad=0.01, aspect=30)
    bar.set_label("colour: error / best")
    bar.set_ticks([1, 2, 5, 10], labels=["1", "2", "5", "10"])
    bar.ax.minorticks_off()
    below(figure, mark_handles(findings, marked))
    return figure


def finish_panel(axes, title, index, rows_factor):
    if index == 0 or rows_factor is None:
        axes.set_title(title)
    axes.grid(False)
    axes.tick_params(length=0)
    soften(axes)


def label_axes(grid, across, upwards, columns, lines, rows_factor, levels):
    for axes in grid[-1]:
        axes.set_xticks(range(len(columns)), [level_text(value) for value in columns])
        axes.set_xlabel(across.label)
    for index, axes in enumerate(grid[:, 0]):
        axes.set_yticks(range(len(lines)), [level_text(value) for value in lines])
        text = upwards.label
        if rows_factor is not None:
            text = f"{rows_factor.label} = {level_text(levels[index])}\n{text}"
        axes.set_ylabel(text)


def draw_scatter_map(findings, across, upwards):
    """Points of a sampled design over two of its factors; the colour is the error over all."""
    figure, axes = plt.subplots(figsize=(theme.COLUMN_IN, 2.7), constrained_layout=True)
    points = {row["point"]: row for row in findings.design if row["point"] in findings.scores}
    scores = np.array([findings.scores[name].score for name in points])
    x, y = (np.array([row[factor.name] for row in points.values()])
            for factor in (across, upwards))
    good = np.isfinite(scores)
    if good.any():
        best = scores[good].min()
        shown = axes.scatter(x[good], y[good], c=scores[good] / best, s=22, lw=0.4,
                             edgecolor=theme.TEXT, norm=LogNorm(1.0, WORST), cmap=theme.ERROR_MAP)
        bar = figure.colorbar(shown, extend="max")
        bar.set_label("error / best setting")
        bar.set_ticks([1, 2, 5, 10], labels=["1", "2", "5", "10"])
        bar.ax.minorticks_off()
    axes.plot(x[~good], y[~good], "x", color=theme.END, ms=5, mew=1.2)
    for factor, set_scale, axis in ((across, axes.set_xscale, axes.xaxis),
                                    (upwards, axes.set_yscale, axes.yaxis)):
        if factor.scale == LOG:
            set_scale("log")
            plain_log(axis, *axis.get_view_interval())
    marked = {name: row for name, row in findings.marks.items()
              if row[across.name] is not None and row[upwards.name] is not None}
    draw_marks(axes, findings, {name: (row[across.name], row[upwards.name])
                                for name, row in marked.items()})
    axes.set(xlabel=across.label, ylabel=upwards.label)
    handles = mark_handles(findings, marked)
    if not good.all():
        handles.append(Line2D([], [], ls="", marker="x", color=theme.END, ms=5, mew=1.2,
                              label="fails on a recording"))
    below(figure, handles)
    return figure
