# SPDX-License-Identifier: MIT
"""The map with the path: from above and from two sides, and as a little picture."""
import matplotlib
import matplotlib.patheffects
import numpy as np

from trajlo_report import theme
from trajlo_report.evaluated import AXES
from trajlo_report.figures_path import ticks

OUTLINE = [matplotlib.patheffects.withStroke(linewidth=3.2, foreground="white")]


def map_bounds(points, run):
    """Low and high corner: a few far points must not make everything else small."""
    ways = np.concatenate([run.positions, run.estimate.truth]) if run.is_evaluated \
        else run.positions
    low, high = ways.min(axis=0), ways.max(axis=0)
    if len(points):
        near = np.percentile(points, [0.5, 99.5], axis=0)
        low, high = np.minimum(low, near[0]), np.maximum(high, near[1])
    reach = max(high - low)
    middle, half = (low + high) / 2, np.maximum(high - low, max(0.1 * reach, 1.0)) / 2
    return middle - half - 0.03 * reach, middle + half + 0.03 * reach


def density_image(points, heights, bounds, across, upwards, pixels):
    """Hue by height, strength by how many points lie in a pixel."""
    low, high = bounds
    shape = np.maximum((high - low)[[upwards, across]] / max(high - low) * pixels, 8).astype(int)
    extent = [[low[upwards], high[upwards]], [low[across], high[across]]]
    count, _, _ = np.histogram2d(points[:, upwards], points[:, across], shape, extent)
    height, _, _ = np.histogram2d(points[:, upwards], points[:, across], shape, extent,
                                  weights=points[:, 2].astype(float))
    filled = count > 0
    if not filled.any():
        return np.ones((*shape, 4)) * [1, 1, 1, 0]
    height[filled] /= count[filled]
    hue = np.clip((height - heights[0]) / max(heights[1] - heights[0], 1e-6), 0, 1)
    strength = np.log1p(count) / np.log1p(np.percentile(count[filled], 98))
    image = matplotlib.colormaps["turbo"](0.07 + 0.86 * hue)
    image[..., 3] = np.where(filled, 0.4 + 0.55 * np.clip(strength, 0, 1), 0)
    return image


def height_range(points):
    return tuple(np.percentile(points[:, 2], [1, 99])) if len(points) else (0.0, 1.0)


def draw_plane(axes, run, bounds, heights, across, upwards, points, pixels=900):
    """Map, truth and path in one plane."""
    low, high = bounds
    if len(points):
        image = density_image(points, heights, bounds, across, upwards, pixels)
        axes.imshow(image, origin="lower", interpolation="antialiased", zorder=1, extent=[
            low[across], high[across], low[upwards], high[upwards]])
    if run.is_evaluated:
        axes.plot(*run.estimate.truth[:, [across, upwards]].T, color=theme.TRUTH, lw=1.0, ls="--",
                  label="truth", path_effects=OUTLINE, zorder=3)
    axes.plot(*run.positions[:, [across, upwards]].T, color=theme.PATH, lw=1.3, label="path",
              path_effects=OUTLINE, zorder=2)
    ends = {"markeredgecolor": "white", "markeredgewidth": 0.8, "zorder": 5, "ls": ""}
    axes.plot(*run.positions[0, [across, upwards]], "o", color=theme.START, ms=6, label="start",
              **ends)
    axes.plot(*run.positions[-1, [across, upwards]], "s", color=theme.END, ms=5.5, label="end",
              **ends)
    axes.set(xlim=(low[across], high[across]), ylim=(low[upwards], high[upwards]), aspect="equal")


def layout(low, high, width_in):
    """Places (inches) for a view from above, one from the front below it and one from the side at
    its right, all on the same scale; and the size of the figure."""
    dx, dy, dz = high - low
    left, right, bottom, gap, top = 0.55, 0.85, 0.42, 0.42, 0.3
    scale = (width_in - left - right - gap) / (dx + dz)
    scale = min(scale, (1.25 * width_in - top - bottom - gap) / (dy + dz))
    upper, beside = bottom + scale * dz + gap, left + scale * dx + gap
    places = [(left, upper, scale * dx, scale * dy), (left, bottom, scale * dx, scale * dz),
              (beside, upper, scale * dz, scale * dy)]
    return places, (beside + scale * dz + right, upper + scale * dy + top), scale


def draw_views(run, ceiling_m=None, width_in=7.6):
    """From above (without what is above the ceiling's height), from the front and from the side."""
    points = run.cloud.points if run.cloud else np.zeros((0, 3))
    below = points[points[:, 2] < ceiling_m] if ceiling_m is not None else points
    low, high = bounds = map_bounds(points, run)
    heights = height_range(below)
    places, size, scale = layout(low, high, width_in)
    figure = theme.plt.figure(figsize=size)
    panels = []
    for (x, y, w, h), shown, (across, upwards) in zip(places, (below, points, points),
                                                      ((0, 1), (0, 2), (2, 1))):
        axes = figure.add_axes([x / size[0], y / size[1], w / size[0], h / size[1]])
        draw_plane(axes, run, bounds, heights, across, upwards, shown)
        axes.xaxis.set_major_locator(ticks(scale * (high - low)[across] / 0.45))
        axes.yaxis.set_major_locator(ticks(scale * (high - low)[upwards] / 0.3))
        panels.append(axes)
    panels[0].set_ylabel(f"{AXES[1]} [m]")
    panels[1].set(xlabel=f"{AXES[0]} [m]", ylabel=f"{AXES[2]} [m]")
    panels[2].set_xlabel(f"{AXES[2]} [m]")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="upper left", ncol=4, frameon=False, borderaxespad=0.1,
                  bbox_to_anchor=(places[0][0] / size[0], 1.0))
    if len(points):
        x, y, w, h = places[2]
        bar_axes = figure.add_axes([(x + w + 0.12) / size[0], y / size[1], 0.1 / size[0],
                                    min(h, 2.2) / size[1]])
        height_bar(figure, bar_axes, heights)
    return figure


def height_bar(figure, axes, heights):
    colors = matplotlib.colors.ListedColormap(
        matplotlib.colormaps["turbo"](np.linspace(0.07, 0.93, 128)))
    scale = matplotlib.cm.ScalarMappable(matplotlib.colors.Normalize(*heights), colors)
    bar = figure.colorbar(scale, cax=axes)
    bar.set_label("height [m]")
    bar.outline.set_linewidth(0.4)


def draw_thumbnail(run, ceiling_m=None):
    """The view from above, small, with axes in metres."""
    points = run.cloud.points if run.cloud else np.zeros((0, 3))
    if ceiling_m is not None:
        points = points[points[:, 2] < ceiling_m]
    bounds = map_bounds(points, run)
    figure, axes = theme.plt.subplots(figsize=(2.4, 1.9), constrained_layout=True)
    draw_plane(axes, run, bounds, height_range(points), 0, 1, points, pixels=300)
    axes.set_aspect("equal", adjustable="datalim")
    axes.tick_params(labelsize=5.5, length=2, pad=1)
    axes.xaxis.set_major_locator(ticks(4))
    axes.yaxis.set_major_locator(ticks(3))
    axes.set_xlabel("x [m]", fontsize=5.5, labelpad=1)
    axes.set_ylabel("y [m]", fontsize=5.5, labelpad=1)
    return figure
