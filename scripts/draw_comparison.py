#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws what trajlo_compare_solvers found: figures for papers, and a page with tables and figures.

  scripts/draw_comparison.py DIR      writes DIR/report.html and, in DIR/figures, each figure as
                                      SVG, PDF and PNG
DIR is the output folder of trajlo_compare_solvers. Needs Debian's python3-numpy,
python3-matplotlib and python3-jinja2.

Exit codes: 0 done, 1 wrong usage, 2 input unreadable, 5 output not writable.
"""
import pathlib
import sys

from trajlo_report import comparison_words as words
from trajlo_report import figures_comparison as figures
from trajlo_report import command_line, files, names, page, theme


def with_notes(caption, left_out):
    """A reader who misses a variant is told why."""
    notes = "".join(f" Not shown: {words.listed(names)}; {why}." for names, why in left_out)
    return f"{caption}.{notes}"


def draw_lockstep(folder, lockstep, width_in):
    """Figures of single windows: (name, figure or nothing, caption)."""
    table = files.read_columns(folder / "lockstep.csv")
    iterations = files.read_columns(folder / "iterations.csv")
    first, slow = lockstep[0]["name"], figures.too_slow(lockstep)
    slow = [(slow, f"they take more than {figures.FAST:.0f} times as long as {first} and are in "
             "the right panel only")] if slow else []
    return [
        ("cost", figures.draw_costs(iterations, lockstep, width_in),
         with_notes("Cost above the lowest of the window after each step, median over the windows",
                    figures.without_curve(iterations, lockstep))),
        ("stages", figures.draw_stages(lockstep, width_in),
         with_notes(f"Time of a window by stage, and relative to {first}", slow)),
        ("distances", figures.draw_distances(table, lockstep, width_in),
         with_notes(f"Share of the windows whose solution is at most this far from that of {first}",
                    [([first], "the others are compared with it")])),
        ("points", figures.draw_points(table, lockstep, width_in),
         with_notes("Time of a step against the number of points; each mark is a window", []))]


def draw_all(folder, lockstep, free, width_in):
    """The figures that the data allow."""
    drawn = draw_lockstep(folder, lockstep, width_in) if lockstep else []
    if free:
        drawn.append(("free", figures.draw_free(free, width_in), with_notes(
            "Whole runs: processor time, distance between trajectories, error", [])))
    return drawn


def make_parser():
    parser = command_line.Parser(description=__doc__)
    parser.add_argument("comparison", type=pathlib.Path,
                        help="output folder of trajlo_compare_solvers")
    parser.add_argument("--title", default="Comparison of solvers")
    return parser


def draw(arguments):
    folder = arguments.comparison
    document = files.read_json(folder / "comparison.json")
    theme.apply()
    lockstep = [item for item in document["variants"] if "lockstep" in item]
    free = [item for item in document["variants"] if "free" in item]
    files.make_folder(folder / "figures")
    drawn, undrawn = [], []
    for name, figure, caption in draw_all(folder, lockstep, free, theme.COLUMN_IN):
        if figure is None:
            undrawn.append(caption)
            continue
        width = int(140 * figure.get_size_inches()[0])
        paths = theme.save(figure, folder / "figures" / name)
        drawn.append({"path": paths[0], "caption": caption, "width": width})
    times = files.read_columns(folder / "lockstep.csv") if lockstep else {}
    report = folder / "report.html"
    files.write_atomically(report, page.render(
        "comparison.html", title=arguments.title, document=document, lockstep=lockstep,
        free=free, figures=drawn, versions=page.flatten(document["versions"]),
        conclusions=[
            *words.of_end(document), *words.of_windows(lockstep, times),
            *words.by_whole_runs_only(document["variants"]), *words.of_runs(free)],
        undrawn=undrawn, few_poses=words.few_poses, warnings=document.get("warnings", []),
        compared=words.compared,
        leaves_s={item["name"]: words.since_begin(folder, item) for item in free},
        length=words.small_length, config=(folder / "config.yaml").read_text()))
    print(f"{report}: {names.counted(len(document['variants']), 'variant')}, "
          f"{names.counted(len(drawn), 'figure')}")
    return 0


if __name__ == "__main__":
    sys.exit(command_line.guarded(make_parser(), draw))
