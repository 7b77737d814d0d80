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
import pathlib
import sys

import numpy as np

from trajlo_report import alignment, figures_run, files
from trajlo_report import theme as themes


def draw(theme, points, times, positions, windows, truth, cut):
    """Map on the left; height, inliers and times on the right."""
    themes.apply(theme, font_size=9)
    figure = themes.plt.figure(figsize=(16, 9), constrained_layout=True)
    grid = figure.add_gridspec(3, 2, width_ratios=[1.35, 1])
    figures_run.draw_map(figure.add_subplot(grid[:, 0]), points, positions, theme, truth, cut)
    first = figure.add_subplot(grid[0, 1])
    figures_run.draw_height(first, times, positions, theme, truth, times[0])
    if windows:
        figures_run.draw_inliers(figure.add_subplot(grid[1, 1], sharex=first), windows, theme,
                                 times[0])
        figures_run.draw_stages(figure.add_subplot(grid[2, 1], sharex=first), windows, theme,
                                times[0])
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("result", type=pathlib.Path, help="the output folder of trajlo_run")
    parser.add_argument("--truth", type=pathlib.Path, help="true poses in TUM's format")
    parser.add_argument("--output", type=pathlib.Path, help="the PNG to write")
    parser.add_argument("--cut", type=float, help="leave out map points above this height, m")
    parser.add_argument("--title", help="in place of the folder's name")
    parser.add_argument("--theme", choices=themes.THEMES, default="dark")
    arguments = parser.parse_args()
    needed = [arguments.result / name for name in ("trajectory.tum", "map.ply", "windows.csv")]
    needed += [arguments.truth] if arguments.truth else []
    for path in needed:
        if not path.is_file():
            sys.exit(f"plot_run.py: {path} is missing")
    try:
        times, positions = files.read_tum(needed[0])
        points = files.read_ply(needed[1])
        windows = files.read_columns(needed[2])
        truth = alignment.compare(times, positions, arguments.truth) if arguments.truth else None
    except files.ReportError as error:
        sys.exit(f"plot_run.py: {error}")

    figure = draw(themes.THEMES[arguments.theme], points, times, positions, windows, truth,
                  arguments.cut)
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
