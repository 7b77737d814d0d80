# SPDX-License-Identifier: MIT
"""Evaluated trajectories in space."""
import matplotlib.collections
import matplotlib.colors
import matplotlib.pyplot as plt
import matplotlib.ticker
import numpy as np

from trajlo_report import theme
from trajlo_report.evaluated import (AXES, bounds, drawable, legend_over, legend_width,
                                     longest_truth, with_gaps)


def draw_planes(estimates, width_in=theme.COLUMN_IN):
    """Truth and estimates in the planes xy, xz and zy, one scale for all: a third-angle drawing."""
    low, high = bounds(estimates)
    dx, dy, dz = high - low
    names = ["truth", *(estimate.name for _, estimate in drawable(estimates)), "start"]
    legend_columns = legend_width(names, width_in)
    top = 0.12 + 0.16 * -(-len(names) // legend_columns)
    left, right, bottom, gap = 0.55, 0.08, 0.4, 0.42
    scale = (width_in - left - right - gap) / (dx + dz)
    height_in = top + bottom + gap + scale * (dy + dz)
    # A long way north must not become a poster.
    if height_in > 1.4 * width_in:
        height_in = 1.4 * width_in
        scale = (height_in - top - bottom - gap) / (dy + dz)
    figure = plt.figure(figsize=(width_in, height_in))

    def place(x_in, y_in, w, h):
        return figure.add_axes([x_in / width_in, y_in / height_in, scale * w / width_in,
                                scale * h / height_in])

    upper = bottom + scale * dz + gap
    beside = left + scale * dx + gap
    panels = [(place(left, upper, dx, dy), 0, 1), (place(left, bottom, dx, dz), 0, 2),
              (place(beside, upper, dz, dy), 2, 1)]
    _, truth = longest_truth(estimates)
    for axes, i, j in panels:
        axes.plot(truth[:, i], truth[:, j], color=theme.TRUTH, lw=2.2, alpha=0.35, label="truth")
        for index, estimate in drawable(estimates):
            _, positions = with_gaps(estimate.times, estimate.positions)
            axes.plot(positions[:, i], positions[:, j], lw=0.9, label=estimate.name,
                      **theme.method_style(index))
        axes.plot(truth[0, i], truth[0, j], "o", ms=3.5, color=theme.START, zorder=5, label="start")
        axes.set(xlim=(low[i], high[i]), ylim=(low[j], high[j]))
        axes.xaxis.set_major_locator(ticks(scale * (high - low)[i] / 0.45))
        axes.yaxis.set_major_locator(ticks(scale * (high - low)[j] / 0.25, 2))
    panels[0][0].set(ylabel="y [m]")
    panels[1][0].set(xlabel="x [m]", ylabel="z [m]")
    panels[2][0].set(xlabel="z [m]")
    handles, labels = panels[0][0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="upper center", ncol=legend_columns, frameon=False,
                  borderaxespad=0.1, columnspacing=1.2)
    return figure


def ticks(how_many, least=1):
    """Two tell the scale, and three fit into the lowest strip; side by side they may not."""
    return matplotlib.ticker.MaxNLocator(max(least, int(how_many)), min_n_ticks=least,
                                         steps=[1, 2, 2.5, 5, 10])


def widest_plane(low, high):
    """The two axes with the largest extents, in the order of the alphabet; of equal ones the first."""
    return sorted(np.argsort(-np.round(high - low, 6), kind="stable")[:2])


def draw_error_on_path(estimates, width_in=theme.COLUMN_IN):
    """Each estimate in its widest plane, coloured by its translation error; one scale for all."""
    items = drawable(estimates)
    low, high = bounds(estimates)
    i, j = widest_plane(low, high)
    aspect = (high[j] - low[j]) / (high[i] - low[i])
    columns = min(len(items), 4 if aspect > 2 else 2)
    rows = -(-len(items) // columns)
    panel_in = (width_in - 0.9) / columns
    aspect = np.clip(aspect, 0.25, 3.0)
    figure, grid = plt.subplots(rows, columns, squeeze=False, sharex=True, sharey=True,
                                figsize=(width_in, rows * (panel_in * aspect + 0.25) + 0.4),
                                constrained_layout=True)
    sane = [item.errors["translation_error_m"] for _, item in items if not item.diverged]
    every = np.concatenate(sane or [item.errors["translation_error_m"] for _, item in items])
    norm = matplotlib.colors.Normalize(0, max(float(np.nanpercentile(every, 99)), 1e-9))
    _, truth = longest_truth(estimates)
    lines = None
    for axes, (_, estimate) in zip(grid.flat, items):
        axes.plot(truth[:, i], truth[:, j], color=theme.TRUTH, lw=0.5, alpha=0.5, label="truth")
        positions = estimate.positions[:, [i, j]]
        pieces = np.stack([positions[:-1], positions[1:]], axis=1)
        error = estimate.errors["translation_error_m"]
        lines = matplotlib.collections.LineCollection(
            pieces, cmap=theme.ERROR_MAP, norm=norm, lw=2.0, rasterized=len(pieces) > 1000)
        lines.set_array(0.5 * (error[:-1] + error[1:]))
        axes.add_collection(lines)
        axes.plot(*truth[0, [i, j]], "o", ms=3.5, color=theme.START, zorder=5, label="start")
        axes.set(xlim=(low[i], high[i]), ylim=(low[j], high[j]), aspect="equal")
        if len(items) > 1:
            axes.set_title(estimate.name)
    for axes in grid.flat[len(items):]:
        axes.set_visible(False)
    for axes in grid[-1]:
        axes.set_xlabel(f"{AXES[i]} [m]")
    for axes in grid[:, 0]:
        axes.set_ylabel(f"{AXES[j]} [m]")
    legend_over(figure, grid[0, 0])
    bar = figure.colorbar(lines, ax=grid, fraction=0.05, pad=0.02, extend="max")
    bar.set_label("translation error [m]")
    bar.outline.set_linewidth(0.5)
    return figure
