#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws what trajlo_compare_solvers found: figures for papers, and a page with tables and figures.

  scripts/draw_comparison.py DIR                  writes DIR/report.html, DIR/figures/*.svg, *.png
DIR is the output folder of trajlo_compare_solvers. Needs Debian's python3-numpy,
python3-matplotlib and python3-jinja2.
"""
import argparse
import pathlib
import sys

from trajlo_report import figures_comparison as figures
from trajlo_report import files, page
from trajlo_report import theme


def draw_all(folder, lockstep, free, width_in):
    """The figures that the data allow: (name, figure, caption)."""
    drawn = []
    if lockstep:
        table = files.read_columns(folder / "lockstep.csv")
        iterations = files.read_columns(folder / "iterations.csv")
        comparable = figures.of_one_energy(lockstep)
        drawn += [
            ("cost", figures.draw_costs(iterations, comparable, width_in),
             "Cost above the window's lowest after each step, median over the windows"),
            ("stages", figures.draw_stages(lockstep, width_in),
             "Time of a window by stage, and as a multiple of the first variant's"),
            ("distances", figures.draw_distances(table, lockstep, width_in),
             "Share of the windows whose solution is at most so far from the first variant's"),
            ("points", figures.draw_points(table, lockstep, width_in),
             "Time of a step against the number of points")]
    if free:
        drawn.append(("free", figures.draw_free(free, width_in),
                      "Whole runs: processor time, distance between trajectories, error"))
    return drawn


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("comparison", type=pathlib.Path,
                        help="output folder of trajlo_compare_solvers")
    parser.add_argument("--title", default="Comparison of solvers")
    arguments = parser.parse_args()
    folder = arguments.comparison
    try:
        document = files.read_json(folder / "comparison.json")
    except files.ReportError as error:
        sys.exit(f"draw_comparison.py: {error}")
    theme.apply()
    lockstep = [item for item in document["variants"] if "lockstep" in item]
    free = [item for item in document["variants"] if "free" in item]
    (folder / "figures").mkdir(exist_ok=True)
    drawn = []
    for name, figure, caption in draw_all(folder, lockstep, free, theme.COLUMN_IN):
        paths = theme.save(figure, folder / "figures" / name)
        drawn.append({"path": paths[1], "caption": caption})
    report = folder / "report.html"
    files.write_atomically(report, page.render(
        "comparison.html", title=arguments.title, document=document, lockstep=lockstep,
        free=free, figures=drawn, versions=page.flatten(document["versions"]),
        config=(folder / "config.yaml").read_text()))
    print(f"{report}: {len(document['variants'])} variants, {len(drawn)} figures")


if __name__ == "__main__":
    main()
