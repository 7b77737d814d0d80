# SPDX-License-Identifier: MIT
"""Figures of a comparison of solvers; each takes the columns of its CSV file and the variants."""
import numpy as np

from trajlo_report import theme
from trajlo_report.comparison_words import changes_energy
from trajlo_report.evaluated import legend_over
from trajlo_report.log_axis import plain_log

SMALLEST_M = 1e-16  # solutions that are equal are drawn here
FAST = 3.0          # bars of stages show variants up to this many times the yardstick's time


def rows_of(table, variant):
    """The columns of one variant."""
    mask = np.array([name == variant for name in table["variant"]])
    return {key: np.asarray(values)[mask] for key, values in table.items() if key != "variant"}


def excess_costs(iterations, variant, steps):
    """Cost above the window's lowest, as a share of it, by step: median over the windows.

    A window that has converged keeps its last value."""
    own = rows_of(iterations, variant)
    curves = []
    for window in np.unique(own["window"]):
        costs = own["cost"][own["window"] == window]
        excess = (costs - costs.min()) / max(costs.min(), 1e-300)
        curves.append(np.pad(excess, (0, max(0, steps - len(excess))), mode="edge")[:steps])
    return np.median(curves, axis=0) if curves else np.zeros(0)


def legend_below(axes):
    """Sixteen names hide the data when they stand inside."""
    axes.legend(ncol=3, fontsize=5, loc="upper center", bbox_to_anchor=(0.5, -0.22))


def cost_curves(iterations, variants, steps=12):
    """(index, variant, curve) of those with the same energy, and something to lose."""
    curves = []
    for index, item in enumerate(variants):
        curve = excess_costs(iterations, item["name"], steps)
        curve = np.where(curve > 0, curve, np.nan)
        if not changes_energy(item) and np.isfinite(curve).any():
            curves.append((index, item, curve))
    return curves


def without_curve(iterations, variants):
    """What the figure of costs leaves out, and why."""
    shown = {item["name"] for _, item, _ in cost_curves(iterations, variants)}
    other_energy = [item["name"] for item in variants if changes_energy(item)]
    settled = [item["name"] for item in variants
               if item["name"] not in shown and item["name"] not in other_energy]
    return [(names, why) for names, why in (
        (other_energy, "their kernels change what is minimised, so that costs do not compare"),
        (settled, "they are at their lowest cost from the start")) if names]


def too_slow(variants):
    """Those that would make the bars of all others short."""
    first = variants[0]["lockstep"]["median_total_ms"]
    return [item["name"] for item in variants if item["lockstep"]["median_total_ms"] > FAST * first]


def draw_costs(iterations, variants, width_in):
    """Nothing where no variant has anything to lose."""
    curves = cost_curves(iterations, variants)
    if not curves:
        return None
    figure, axes = theme.plt.subplots(figsize=(width_in, 0.95 * width_in),
                                       constrained_layout=True)
    for index, item, curve in curves:
        axes.semilogy(curve, label=item["name"], marker=".", ms=3,
                      **theme.method_style(index))
    axes.set(xlabel="step", ylabel="cost above the lowest, as a share of it")
    legend_below(axes)
    return figure


def draw_stages(variants, width_in):
    """Milliseconds a window: evaluation, linear equations, and what else a solver does."""
    names = [item["name"] for item in variants]
    totals = np.array([item["lockstep"]["median_total_ms"] for item in variants])
    evaluate = np.array([item["lockstep"]["median_evaluate_ms"] for item in variants])
    linear = np.array([item["lockstep"]["median_linear_solve_ms"] for item in variants])
    slow = too_slow(variants)
    fast = np.array([name not in slow for name in names])
    figure, (bars, dots) = theme.plt.subplots(
        1, 2, figsize=(2 * width_in, 0.16 * width_in + 0.17 * len(names)), sharey=False,
        constrained_layout=True)
    place = np.arange(np.count_nonzero(fast))
    left = np.zeros(len(place))
    parts = (("residuals and Jacobians", evaluate, theme.METHODS[0]),
             ("linear equations", linear, theme.METHODS[4]),
             ("other", np.maximum(totals - evaluate - linear, 0), theme.STAGES["segment"]))
    for label, values, color in parts:
        bars.barh(place, values[fast], left=left, color=color, label=label)
        left += values[fast]
    bars.set_yticks(place, [name for name, is_fast in zip(names, fast) if is_fast])
    bars.set(xlabel="time per window [ms]")
    bars.invert_yaxis()
    dots.plot(totals / totals[0], np.arange(len(names)), "o", color=theme.METHODS[0], ms=4)
    dots.axvline(1.0, color=theme.TEXT, lw=0.6)
    dots.set_yticks(np.arange(len(names)), names)
    dots.set(xlabel=f"time, as a multiple\nof {names[0]}'s", xscale="log")
    plain_log(dots.xaxis, *dots.get_xlim())
    dots.invert_yaxis()
    legend_over(figure, bars)
    return figure


def draw_distances(lockstep, variants, width_in):
    """How far apart solutions of the same window are, as a cumulated histogram; nothing of one
    variant alone."""
    if len(variants) < 2:
        return None
    figure, axes = theme.plt.subplots(figsize=(width_in, 0.95 * width_in),
                                       constrained_layout=True)
    for index, item in enumerate(variants[1:], 1):
        distances = np.sort(np.maximum(rows_of(lockstep, item["name"])["from_first_m"], SMALLEST_M))
        share = np.arange(1, len(distances) + 1) / len(distances)
        axes.step(distances, 100 * share, where="post", label=item["name"],
                  **theme.method_style(index))
    axes.set(xscale="log", xlabel=f"distance from the solution of {variants[0]['name']} [m]",
             ylabel="windows [%]", ylim=(0, 101))
    legend_below(axes)
    return figure


def draw_points(lockstep, variants, width_in):
    """Time of a step against the number of points in the window."""
    figure, axes = theme.plt.subplots(figsize=(width_in, 0.95 * width_in),
                                       constrained_layout=True)
    for index, item in enumerate(variants):
        own = rows_of(lockstep, item["name"])
        tries = np.maximum(own["steps"] + own["rejected_steps"], 1)
        color = theme.method_style(index)["color"]
        axes.plot(own["points"], own["total_ms"] / tries, "osv^D*"[index // 6 % 6], color=color,
                  ms=2, label=item["name"])
    axes.set(yscale="log", xlabel="points in the window", ylabel="time per step [ms]")
    legend_below(axes)
    return figure


def draw_free(variants, width_in):
    """Whole runs: processor time, how far trajectories part, and errors where there is truth."""
    names = [item["name"] for item in variants]
    place = np.arange(len(names))
    errors = [item["free"]["ate_rmse_m"] for item in variants]
    has_errors = any(error is not None for error in errors)
    figure, grid = theme.plt.subplots(
        1, 3 if has_errors else 2, sharey=True, constrained_layout=True,
        figsize=(2 * width_in, 0.16 * width_in + 0.17 * len(names)))
    color = theme.METHODS[0]
    grid[0].barh(place, [item["free"]["cpu_s"] for item in variants], color=color)
    grid[0].set(xlabel="processor time [s]")
    apart = [max(item["free"]["max_from_first_m"], SMALLEST_M) for item in variants]
    grid[1].plot(apart, place, "o", color=color, ms=4)
    grid[1].set(xscale="log", xlabel=f"largest distance\nfrom {names[0]} [m]")
    if has_errors:
        grid[2].barh(place, [error or 0.0 for error in errors], color=color)
        grid[2].set(xlabel="position error, RMSE [m]")
        grid[2].locator_params(axis="x", nbins=4)
    grid[0].set_yticks(place, names)
    grid[0].invert_yaxis()
    return figure
