# SPDX-License-Identifier: MIT
"""Drawings of one run of trajlo_run: its map, its path, and what happened in its windows."""
import matplotlib
import numpy as np


def draw_map(axes, points, positions, theme, truth=None, cut=None):
    """The density of the points from above: hue by height, brightness by how many lie there."""
    if cut is not None:
        points = points[points[:, 2] < cut]
    ends = np.vstack([points[:, :2], positions[:, :2]])
    # A few far points must not make everything else small.
    low, high = np.percentile(ends, [0.5, 99.5], axis=0)
    low = np.minimum(low, positions[:, :2].min(axis=0)) - 1.0
    high = np.maximum(high, positions[:, :2].max(axis=0)) + 1.0
    span = max(high - low)
    low, high = (low + high - span) / 2, (low + high + span) / 2
    pixels = int(np.clip(np.sqrt(len(points)) * 1.8, 250, 900))
    bounds = [[low[1], high[1]], [low[0], high[0]]]
    count, _, _ = np.histogram2d(points[:, 1], points[:, 0], pixels, bounds)
    height, _, _ = np.histogram2d(points[:, 1], points[:, 0], pixels, bounds,
                                  weights=points[:, 2].astype(float))
    filled = count > 0
    height[filled] /= count[filled]
    z_low, z_high = np.percentile(points[:, 2], [2, 98]) if len(points) else (0.0, 1.0)
    hue = np.clip((height - z_low) / max(z_high - z_low, 1e-6), 0, 1)
    bright = np.zeros_like(count)
    if filled.any():
        bright = 0.4 + 0.6 * np.log1p(count) / np.log1p(np.percentile(count[filled], 99.5))
    bright = np.where(filled, np.clip(bright, 0, 1), 0)[..., None]
    image = matplotlib.colormaps["turbo"](0.08 + 0.84 * hue)[..., :3] * bright
    image += np.array(matplotlib.colors.to_rgb(theme.background)) * (1 - bright)
    axes.imshow(image, origin="lower", extent=[low[0], high[0], low[1], high[1]],
                interpolation="antialiased")
    if truth:
        axes.plot(*truth["path"][:, :2].T, color=theme.truth, lw=1.2, ls="--",
                  label="truth, aligned")
    axes.plot(*positions[:, :2].T, color=theme.path, lw=1.6, label="trajectory")
    axes.plot(*positions[0, :2], "o", color=theme.start, ms=6, label="start")
    axes.plot(*positions[-1, :2], "s", color=theme.end, ms=6, label="end")
    axes.set(xlabel="x [m]", ylabel="y [m]")
    axes.grid(False)
    axes.legend(loc="upper right")
    scale = matplotlib.cm.ScalarMappable(matplotlib.colors.Normalize(z_low, z_high), "turbo")
    bar = axes.figure.colorbar(scale, ax=axes, fraction=0.03, pad=0.01)
    bar.set_label("height of the map points [m]")
    bar.outline.set_edgecolor(theme.grid)


def draw_height(axes, times, positions, theme, truth, start):
    axes.plot(times - start, positions[:, 2], color=theme.methods[0], label="height")
    axes.set_ylabel("height [m]")
    if truth:
        right = axes.twinx()
        right.plot(truth["times"] - start, 100 * truth["error"], color=theme.truth, lw=1.0)
        right.set_ylabel("error [cm]", color=theme.truth)
        right.set_ylim(bottom=0)
        right.grid(False)


def draw_position(axes, times, positions, theme, start):
    for axis, name in enumerate("xyz"):
        axes.plot(times - start, positions[:, axis], color=theme.methods[axis], label=name)
    axes.set_ylabel("position [m]")
    axes.legend(loc="upper left", ncol=3)


def draw_inliers(axes, windows, theme, start):
    """Share of points with a plane, and the information in the weakest direction."""
    at = windows["end_s"] - start
    axes.plot(at, 100 * windows["inlier_share"], color=theme.stages["map"])
    axes.set(ylabel="inliers [%]", ylim=(0, 100))
    right = axes.twinx()
    right.semilogy(at, np.maximum(windows["smallest_eigenvalue"], 1e-6),
                   color=theme.stages["solve"], lw=1.0)
    right.set_ylabel("smallest eigenvalue", color=theme.stages["solve"])
    right.grid(False)


def draw_eigenvalue(axes, windows, theme, start, degenerate=None):
    """The information per point in the weakest direction, and where it counts as degenerate."""
    axes.semilogy(windows["end_s"] - start, np.maximum(windows["smallest_eigenvalue"], 1e-6),
                  color=theme.stages["solve"], lw=1.0)
    if degenerate:
        axes.axhline(degenerate, color=theme.end, lw=0.8, ls="--", label="degenerate below")
        axes.legend(loc="best")
    axes.set_ylabel("smallest eigenvalue")


def draw_stages(axes, windows, theme, start):
    at = windows["end_s"] - start
    stages = [np.asarray(windows[f"{name}_ms"], dtype=float) for name in theme.stages]
    # Means over half a second: single windows only make a flicker.
    width = max(1, int(round(0.5 / max(np.median(np.diff(at)) if len(at) > 1 else 0.5, 1e-3))))
    width = min(width, len(at))
    counts = np.convolve(np.ones(len(at)), np.ones(width), mode="same")
    stages = [np.convolve(stage, np.ones(width), mode="same") / counts for stage in stages]
    axes.stackplot(at, stages, colors=list(theme.stages.values()), labels=list(theme.stages))
    axes.set(ylabel="ms per window", xlabel="time [s]")
    axes.margins(y=0.3)
    axes.legend(loc="upper left", ncol=5)
