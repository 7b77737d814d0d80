#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws the result of trajlo_run: map and trajectory from above, and what happened over time.

  scripts/plot_run.py RESULT                            writes RESULT/picture.png
  scripts/plot_run.py RESULT --truth truth.tum          with the true path and the error
  scripts/plot_run.py RESULT --output picture.png --cut 2.5
                                                        without what is above 2.5 m (a ceiling)
Needs Debian's python3-numpy and python3-matplotlib.
"""
import argparse
import csv
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

BACKGROUND = "#0d1117"
PANEL = "#11161d"
TEXT = "#c9d1d9"
GRID = "#2b323b"
PATH = "#ffffff"
TRUTH = "#ff7b72"
STAGES = {"segment_ms": "#8b949e", "associate_ms": "#58a6ff", "solve_ms": "#f2cc60",
          "marginalize_ms": "#bc8cff", "map_ms": "#56d364"}


def read_tum(path):
    """Times (s) and positions (m) of a TUM file; an unfinished last line is left out."""
    rows = []
    for line in path.read_text().splitlines():
        values = line.split()
        if len(values) == 8 and not line.startswith("#"):
            rows.append([float(value) for value in values[:4]])
    if not rows:
        sys.exit(f"plot_run.py: {path} holds no poses")
    rows = np.array(rows)
    return rows[:, 0], rows[:, 1:]


def read_ply(path):
    """Points of a binary little-endian PLY whose vertices are floats with x, y, z in front."""
    data = path.read_bytes()
    head, _, _ = data.partition(b"end_header\n")
    lines = head.decode("ascii").splitlines()
    if "format binary_little_endian 1.0" not in lines:
        sys.exit(f"plot_run.py: {path} is not a binary little-endian PLY")
    count = next(int(line.split()[2]) for line in lines if line.startswith("element vertex"))
    names = [line.split()[2] for line in lines if line.startswith("property float")]
    values = np.frombuffer(data, "<f4", count * len(names), len(head) + len(b"end_header\n"))
    return values.reshape(count, len(names))[:, [names.index(axis) for axis in "xyz"]]


def read_windows(path):
    """Columns of windows.csv as arrays; texts stay lists."""
    with path.open() as file:
        rows = list(csv.DictReader(file))
    columns = {}
    for name in rows[0] if rows else ():
        try:
            columns[name] = np.array([float(row[name]) for row in rows])
        except ValueError:
            columns[name] = [row[name] for row in rows]
    return columns


def align(estimate, truth):
    """The rigid motion (R, t) that brings `estimate` nearest to `truth` (Umeyama, no scale)."""
    mean_e, mean_t = estimate.mean(axis=0), truth.mean(axis=0)
    u, _, vt = np.linalg.svd((truth - mean_t).T @ (estimate - mean_e))
    flip = np.diag([1.0, 1.0, np.sign(np.linalg.det(u @ vt))])
    rotation = u @ flip @ vt
    return rotation, mean_t - rotation @ mean_e


def compare(times, positions, truth_file):
    """Truth in the estimate's frame, and the error (m) at each estimated pose that it covers."""
    truth_times, truth = read_tum(truth_file)
    inside = (times >= truth_times[0]) & (times <= truth_times[-1])
    if inside.sum() < 3:
        sys.exit(f"plot_run.py: {truth_file} covers fewer than 3 poses of the trajectory")
    at = np.stack([np.interp(times[inside], truth_times, truth[:, i]) for i in range(3)], axis=1)
    rotation, translation = align(at, positions[inside])
    aligned = at @ rotation.T + translation
    error = np.linalg.norm(positions[inside] - aligned, axis=1)
    overlay = truth[(truth_times >= times[0]) & (truth_times <= times[-1])]
    return {"times": times[inside], "error": error, "path": overlay @ rotation.T + translation,
            "rmse": float(np.sqrt(np.mean(error**2)))}


def draw_map(axes, points, positions, truth, cut):
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
    image += np.array(matplotlib.colors.to_rgb(BACKGROUND)) * (1 - bright)
    axes.imshow(image, origin="lower", extent=[low[0], high[0], low[1], high[1]],
                interpolation="antialiased")
    if truth:
        axes.plot(*truth["path"][:, :2].T, color=TRUTH, lw=1.2, ls="--", label="truth, aligned")
    axes.plot(*positions[:, :2].T, color=PATH, lw=1.6, label="trajectory")
    axes.plot(*positions[0, :2], "o", color="#56d364", ms=6, label="start")
    axes.plot(*positions[-1, :2], "s", color="#f85149", ms=6, label="end")
    axes.set(xlabel="x [m]", ylabel="y [m]")
    axes.grid(False)
    axes.legend(loc="upper right", facecolor=PANEL, edgecolor=GRID, labelcolor=TEXT)
    scale = matplotlib.cm.ScalarMappable(matplotlib.colors.Normalize(z_low, z_high), "turbo")
    bar = axes.figure.colorbar(scale, ax=axes, fraction=0.03, pad=0.01)
    bar.set_label("height of the map points [m]")
    bar.outline.set_edgecolor(GRID)


def draw_height(axes, times, positions, truth, start):
    axes.plot(times - start, positions[:, 2], color="#58a6ff", label="height")
    axes.set_ylabel("height [m]")
    if truth:
        right = axes.twinx()
        right.plot(truth["times"] - start, 100 * truth["error"], color=TRUTH, lw=1.0)
        right.set_ylabel("error [cm]", color=TRUTH)
        right.set_ylim(bottom=0)
        right.grid(False)


def draw_inliers(axes, windows, start):
    at = windows["end_s"] - start
    axes.plot(at, 100 * windows["inlier_share"], color="#56d364")
    axes.set(ylabel="inliers [%]", ylim=(0, 100))
    right = axes.twinx()
    right.semilogy(at, np.maximum(windows["smallest_eigenvalue"], 1e-6), color="#f2cc60", lw=1.0)
    right.set_ylabel("smallest eigenvalue", color="#f2cc60")
    right.grid(False)


def draw_stages(axes, windows, start):
    at = windows["end_s"] - start
    stages = [np.asarray(windows[name], dtype=float) for name in STAGES]
    # Means over half a second: single windows only make a flicker.
    width = max(1, int(round(0.5 / max(np.median(np.diff(at)) if len(at) > 1 else 0.5, 1e-3))))
    width = min(width, len(at))
    stages = [np.convolve(stage, np.ones(width) / width, mode="same") for stage in stages]
    axes.stackplot(at, stages, colors=list(STAGES.values()),
                   labels=[name[:-3] for name in STAGES])
    axes.set(ylabel="ms per window", xlabel="time [s]")
    axes.margins(y=0.3)
    axes.legend(loc="upper left", ncol=5, fontsize=7, facecolor=PANEL, edgecolor=GRID,
                labelcolor=TEXT)


def set_style():
    plt.rcParams.update({
        "figure.facecolor": BACKGROUND, "axes.facecolor": PANEL, "savefig.facecolor": BACKGROUND,
        "text.color": TEXT, "axes.labelcolor": TEXT, "axes.edgecolor": GRID, "xtick.color": TEXT,
        "ytick.color": TEXT, "grid.color": GRID, "axes.grid": True, "font.size": 9,
        "axes.axisbelow": True,
    })


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("result", type=pathlib.Path, help="the output folder of trajlo_run")
    parser.add_argument("--truth", type=pathlib.Path, help="true poses in TUM's format")
    parser.add_argument("--output", type=pathlib.Path, help="the PNG to write")
    parser.add_argument("--cut", type=float, help="leave out map points above this height, m")
    parser.add_argument("--title", help="in place of the folder's name")
    arguments = parser.parse_args()
    needed = [arguments.result / name for name in ("trajectory.tum", "map.ply", "windows.csv")]
    needed += [arguments.truth] if arguments.truth else []
    for path in needed:
        if not path.is_file():
            sys.exit(f"plot_run.py: {path} is missing")

    times, positions = read_tum(needed[0])
    windows = read_windows(needed[2])
    truth = compare(times, positions, arguments.truth) if arguments.truth else None

    set_style()
    figure = plt.figure(figsize=(16, 9), constrained_layout=True)
    grid = figure.add_gridspec(3, 2, width_ratios=[1.35, 1])
    draw_map(figure.add_subplot(grid[:, 0]), read_ply(needed[1]), positions, truth, arguments.cut)
    first = figure.add_subplot(grid[0, 1])
    draw_height(first, times, positions, truth, times[0])
    if windows:
        draw_inliers(figure.add_subplot(grid[1, 1], sharex=first), windows, times[0])
        draw_stages(figure.add_subplot(grid[2, 1], sharex=first), windows, times[0])
    length = np.linalg.norm(np.diff(positions, axis=0), axis=1).sum()
    title = f"{arguments.title or arguments.result}: {length:.1f} m in {times[-1] - times[0]:.1f} s"
    if truth:
        title += f", position RMSE after alignment {truth['rmse']:.3f} m"
    figure.suptitle(title, fontsize=13)
    output = arguments.output or arguments.result / "picture.png"
    figure.savefig(output, dpi=110)
    print(f"{output}: " + title.split(": ", 1)[1])


if __name__ == "__main__":
    main()
