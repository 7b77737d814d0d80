#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""One self-contained page of a run: path, map, times, inliers, options, and errors if evaluated.

  scripts/draw_run.py RESULT                          writes RESULT/run.html, RESULT/figures/
  scripts/draw_run.py RESULT --evaluation EVALUATION  with what trajlo_evaluate found about it
  scripts/draw_run.py RESULT --output PAGE --theme light
RESULT is the output folder of trajlo_run; of an interrupted or lost run, what is there is shown.
Needs Debian's python3-numpy, python3-matplotlib, python3-jinja2 and python3-yaml.
"""
import argparse
import pathlib
import sys

import yaml

from trajlo_report import figures_evaluation, figures_run, files, page
from trajlo_report import theme as themes


def draw_windows(windows, times, positions, theme, degenerate):
    """Position, inliers, weakest direction and milliseconds over one axis of time."""
    figure, grid = themes.plt.subplots(4, 1, sharex=True, figsize=(7.4, 7.0),
                                       constrained_layout=True)
    start = times[0]
    figures_run.draw_position(grid[0], times, positions, theme, start)
    if len(windows.get("end_s", ())):
        grid[1].plot(windows["end_s"] - start, 100 * windows["inlier_share"],
                     color=theme.stages["map"])
        grid[1].set(ylabel="inliers [%]", ylim=(0, 100))
        figures_run.draw_eigenvalue(grid[2], windows, theme, start, degenerate)
        figures_run.draw_stages(grid[3], windows, theme, start)
    figure.align_ylabels(grid)
    return figure


def draw_map(points, positions, theme):
    figure, axes = themes.plt.subplots(figsize=(7.4, 6.4), constrained_layout=True)
    figures_run.draw_map(axes, points, positions, theme)
    return figure


def draw_thumbnail(positions, theme):
    """The path from above, without anything around it."""
    figure, axes = themes.plt.subplots(figsize=(2.4, 1.8))
    axes.set_position([0.03, 0.03, 0.94, 0.94])
    axes.plot(*positions[:, :2].T, color=theme.path, lw=1.2)
    axes.plot(*positions[0, :2], "o", color=theme.start, ms=5)
    axes.plot(*positions[-1, :2], "s", color=theme.end, ms=5)
    axes.set(xticks=[], yticks=[])
    axes.set_aspect("equal", adjustable="datalim")
    return figure


def draw_result(result, theme, folder, config):
    """The figures of the run itself, and a line for each file that is not there to be drawn."""
    figures, missing = [], []
    if not (result / "trajectory.tum").is_file():
        return figures, [f"There is no trajectory in {result}."]
    try:
        times, positions = files.read_tum(result / "trajectory.tum")
    except files.ReportError as error:
        return figures, [f"{error}."]
    themes.save(draw_thumbnail(positions, theme), folder / "thumbnail", ("png",), dpi=100)
    if (result / "map.ply").is_file():
        points = files.read_ply(result / "map.ply")
        path, = themes.save(draw_map(points, positions, theme), folder / "map", ("png",), dpi=110)
        figures.append({"path": path, "caption": "Map and trajectory from above"})
    else:
        missing.append("There is no map.")
    windows = {}
    if (result / "windows.csv").is_file():
        windows = files.read_columns(result / "windows.csv")
    degenerate = config.get("lost", {}).get("degenerate_eigenvalue")
    figure = draw_windows(windows, times, positions, theme, degenerate)
    path, = themes.save(figure, folder / "windows", ("png",), dpi=110)
    figures.append({"path": path, "caption": "Position, share of points with a plane, "
                    "information per point in the weakest direction, milliseconds per stage "
                    "(means over 0.5 s)"})
    return figures, missing


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("result", type=pathlib.Path, help="the output folder of trajlo_run")
    parser.add_argument("--evaluation", type=pathlib.Path, help="output folder of trajlo_evaluate")
    parser.add_argument("--output", type=pathlib.Path, help="the folder to write; default: RESULT")
    parser.add_argument("--theme", choices=themes.THEMES, default="dark")
    parser.add_argument("--title", help="in place of the folder's name")
    arguments = parser.parse_args()
    theme = themes.THEMES[arguments.theme]
    output = arguments.output or arguments.result
    if not arguments.result.is_dir():
        sys.exit(f"draw_run.py: {arguments.result} is not a folder")
    config_file = arguments.result / "config.yaml"
    config = config_file.read_text() if config_file.is_file() else "there is no config.yaml\n"
    try:
        estimates = files.read_evaluation(arguments.evaluation)[1] if arguments.evaluation else []
        run = {"exit": {"code": "unknown", "reason": "the run did not finish", "message": ""}}
        if (arguments.result / "run.json").is_file():
            run = files.read_json(arguments.result / "run.json")
        (output / "figures").mkdir(parents=True, exist_ok=True)
        themes.apply(theme)
        options = yaml.safe_load(config)
        figures, missing = draw_result(arguments.result, theme, output / "figures",
                                       options if isinstance(options, dict) else {})
        evaluated = figures_evaluation.draw_all(estimates, theme, output / "figures", ("png",), 150)
    except files.ReportError as error:
        sys.exit(f"draw_run.py: {error}")
    files.write_atomically(output / "run.html", page.render(
        "run.html", theme, title=arguments.title or str(arguments.result), exit=run["exit"],
        warnings=run.get("warnings", []), missing=missing, figures=figures, estimates=estimates,
        evaluation_figures=evaluated, config=config,
        run=page.flatten(run)))
    print(f"{output / 'run.html'}: {run['exit']['reason']}, "
          f"{len(figures) + len(evaluated)} figures")


if __name__ == "__main__":
    main()
