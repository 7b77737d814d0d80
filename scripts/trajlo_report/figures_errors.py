# SPDX-License-Identifier: MIT
"""Positions and errors of evaluated trajectories over time, and how they are distributed."""
import matplotlib.pyplot as plt
import numpy as np

from trajlo_report import theme
from trajlo_report.evaluated import (AXES, drawable, has_rotation, legend_above,
                                     longest_truth, with_gaps)
from trajlo_report.log_axis import plain_log


def draw_over_time(estimates, width_in=theme.COLUMN_IN):
    """Position by component, translation and rotation error of all estimates over time."""
    items = drawable(estimates)
    with_rotation = any(has_rotation(item) for _, item in items)
    rows = 5 if with_rotation else 4
    figure, grid = plt.subplots(rows, 1, sharex=True, figsize=(width_in, 0.95 * rows + 0.5),
                                constrained_layout=True)
    times, truth = longest_truth(estimates)
    origin = times[0]
    for axis, axes in enumerate(grid[:3]):
        at, true = with_gaps(times, truth[:, axis])
        axes.plot(at - origin, true, color=theme.TRUTH, lw=2.2, alpha=0.35, label="truth")
        for index, estimate in items:
            at, values = with_gaps(estimate.times, estimate.positions[:, axis])
            axes.plot(at - origin, values, lw=0.9, label=estimate.name,
                      **theme.method_style(index))
        axes.set(ylabel=f"{AXES[axis]} [m]", ylim=sane_range(items, axis))
    draw_errors(grid[3], items, origin, "translation_error_m", "position\nerror [m]")
    if with_rotation:
        rotating = [item for item in items if has_rotation(item[1])]
        draw_errors(grid[4], rotating, origin, "rotation_error_deg", "rotation\nerror [°]")
    grid[-1].set_xlabel("time [s]")
    figure.align_ylabels(grid)
    legend_above(figure, grid[0])
    return figure


def sane_range(items, axis):
    """From the least to the most of a component, with a margin; what diverged has no say."""
    values = [item.truth[:, axis] for _, item in items]
    values += [item.positions[:, axis] for _, item in items if not item.diverged]
    low, high = np.nanmin(np.concatenate(values)), np.nanmax(np.concatenate(values))
    margin = 0.08 * (high - low) + 1e-3
    return low - margin, high + margin


def draw_errors(axes, items, origin, column, label):
    medians = []
    for index, estimate in items:
        at, values = with_gaps(estimate.times, estimate.errors[column])
        axes.plot(at - origin, values, lw=0.9, **theme.method_style(index))
        medians.append(max(float(np.nanmedian(estimate.errors[column])), 1e-9))
    # Methods that are far apart would leave the better ones on the zero line.
    if max(medians) > 15 * min(medians):
        axes.set_yscale("log")
        # An error that happens to cross zero says nothing.
        axes.set_ylim(bottom=max(axes.get_ylim()[0], 0.05 * min(medians)))
    else:
        axes.set_ylim(bottom=0)
    axes.set_ylabel(label)


def draw_error_components(estimates, width_in=theme.COLUMN_IN):
    """Error of the position along x, y and z over time."""
    items = drawable(estimates)
    figure, grid = plt.subplots(3, 1, sharex=True, figsize=(width_in, 3.2),
                                constrained_layout=True)
    origin = longest_truth(estimates)[0][0]
    sane = [item for item in items if not item[1].diverged] or items
    for axis, axes in enumerate(grid):
        reach = 0.0
        for index, estimate in items:
            difference = estimate.positions[:, axis] - estimate.truth[:, axis]
            at, values = with_gaps(estimate.times, difference)
            axes.plot(at - origin, values, lw=0.9, label=estimate.name,
                      **theme.method_style(index))
            if (index, estimate) in sane:
                reach = max(reach, float(np.nanmax(np.abs(difference))))
        axes.axhline(0, color=theme.TRUTH, lw=0.6, alpha=0.5)
        axes.set(ylabel=f"{AXES[axis]} error [m]", ylim=(-1.05 * reach - 1e-6, 1.05 * reach + 1e-6))
    grid[-1].set_xlabel("time [s]")
    figure.align_ylabels(grid)
    legend_above(figure, grid[0])
    return figure


def draw_distribution(estimates, width_in=theme.COLUMN_IN):
    """For each estimate the share of poses whose translation error is below a bound."""
    figure, axes = plt.subplots(figsize=(width_in, 2.2), constrained_layout=True)
    for index, estimate in drawable(estimates):
        error = np.sort(estimate.errors["translation_error_m"])
        error = np.maximum(error[np.isfinite(error)], 1e-6)
        axes.step(error, 100 * np.arange(1, len(error) + 1) / len(error), where="post",
                  label=estimate.name, **theme.method_style(index))
    axes.set(xscale="log", ylim=(0, 100), xlabel="translation error [m]", ylabel="poses below [%]")
    plain_log(axes.xaxis, *axes.get_xlim())
    legend_above(figure, axes)
    return figure


def draw_kitti_lengths(estimates, width_in=theme.COLUMN_IN):
    """KITTI's relative errors by the length of the pieces; nothing if no path is long enough."""
    items = [item for item in drawable(estimates) if item[1].metrics.get("kitti")]
    if not items:
        return None
    figure, grid = plt.subplots(2, 1, sharex=True, figsize=(width_in, 2.9),
                                constrained_layout=True)
    for index, estimate in items:
        lengths = [row for row in estimate.metrics["kitti"]["per_length"] if row["segments"]]
        at = [row["length_m"] for row in lengths]
        for axes, key, factor in ((grid[0], "translation_percent", 1.0),
                                  (grid[1], "rotation_deg_per_m", 100.0)):
            axes.plot(at, [factor * row[key] for row in lengths], marker="o", ms=3,
                      label=estimate.name, **theme.method_style(index))
    grid[0].set(ylabel="translation [%]", ylim=(0, None))
    grid[1].set(ylabel="rotation [°/100 m]", ylim=(0, None), xlabel="length of the pieces [m]")
    figure.align_ylabels(grid)
    legend_above(figure, grid[0])
    return figure
