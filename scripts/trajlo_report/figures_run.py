# SPDX-License-Identifier: MIT
"""What happened in the windows of one run, over time."""
import numpy as np

from trajlo_report import theme
from trajlo_report.evaluated import AXES, with_gaps

# The flag `degenerate`: 0.1 m, as core/odometry/health/belief.cc has it.
DEGENERATE = 100.0


def mark_flags(grid, flags):
    """The same bands in all panels."""
    for stretch in flags:
        for axes in grid:
            # Single windows are too short to be seen.
            axes.axvspan(stretch["from"], max(stretch["to"], stretch["from"] + 1e-3),
                         color=theme.FLAG, alpha=0.35, lw=1.0)


def draw_position(axes, run):
    for axis, name in enumerate(AXES):
        axes.plot(run.times - run.begin, run.positions[:, axis], color=theme.METHODS[axis],
                  label=name)
    axes.set_ylabel("position [m]")
    axes.margins(y=0.35)  # room for the legend
    axes.legend(loc="upper left", ncol=3)


def draw_error(axes, run):
    times, error = with_gaps(run.estimate.times, run.estimate.errors["translation_error_m"])
    in_cm = np.nanmax(error) < 1.0
    axes.plot(times - run.begin, 100 * error if in_cm else error, color=theme.TEXT)
    axes.set(ylabel=f"position\nerror [{'cm' if in_cm else 'm'}]", ylim=(0, None))


def draw_inliers(axes, run):
    at = run.windows["end_s"] - run.begin
    axes.plot(at, 100 * run.windows["inlier_share"], color=theme.STAGES["map"],
              label="with a plane")
    axes.plot(at, 100 * run.windows["agreement"], color=theme.STAGES["solve"],
              label="of these, on it (in the worst direction)")
    axes.set(ylabel="points [%]", ylim=(0, 105))
    axes.legend(loc="lower left", ncol=2)


def draw_eigenvalue(axes, run):
    """The information in the weakest direction, and where it counts as degenerate."""
    axes.semilogy(run.windows["end_s"] - run.begin,
                  np.maximum(run.windows["smallest_eigenvalue"], 1.0), color=theme.STAGES["solve"])
    axes.axhline(DEGENERATE, color=theme.END, lw=0.8, ls="--", label="degenerate below")
    axes.legend(loc="best")
    axes.set_ylabel("information in the\nweakest direction [1/m²]")


def draw_stages(axes, run):
    at = run.windows["end_s"] - run.begin
    stages = [np.asarray(run.windows[f"{name}_ms"], dtype=float) for name in theme.STAGES]
    # Means over half a second: single windows only make a flicker.
    width = max(1, int(round(0.5 / max(np.median(np.diff(at)) if len(at) > 1 else 0.5, 1e-3))))
    width = min(width, len(at))
    counts = np.convolve(np.ones(len(at)), np.ones(width), mode="same")
    stages = [np.convolve(stage, np.ones(width), mode="same") / counts for stage in stages]
    axes.stackplot(at, stages, colors=list(theme.STAGES.values()), labels=list(theme.STAGES))
    axes.set(ylabel="time per\nwindow [ms]")
    axes.margins(y=0.3)
    axes.legend(loc="upper left", ncol=5)


def draw_windows(run):
    """Position, error where it is known, and what the estimator says of itself, on one axis."""
    panels = [draw_position] + ([draw_error] if run.is_evaluated else [])
    if len(run.windows.get("end_s", ())):
        panels += [draw_inliers, draw_eigenvalue, draw_stages]
    figure, grid = theme.plt.subplots(len(panels), 1, sharex=True, squeeze=False,
                                      figsize=(7.6, 1.5 * len(panels) + 0.4),
                                      constrained_layout=True)
    grid = grid[:, 0]
    for axes, draw in zip(grid, panels):
        draw(axes, run)
    mark_flags(grid, run.flags)
    grid[-1].set_xlabel("time [s]")
    figure.align_ylabels(grid)
    return figure
