#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws the factor graph of a window: points and residuals, weights, H, and what holds the pose.

  trajlo_run flight.bag -o result --inspect 431     writes the factor graph of window 431
  scripts/draw_window.py result 431                 writes result/windows/000431.html, and each
                                                    figure beside it as SVG, PDF and PNG
  scripts/draw_window.py result                     all windows that are there
Needs Debian's python3-numpy, python3-matplotlib, python3-pil and python3-jinja2.

Exit codes: 0 done, 1 wrong usage, 2 input unreadable, 5 output not writable.
"""
import pathlib
import sys

from trajlo_report import command_line, figures_window, files, page, theme, window_graph

CAPTIONS = {
    "points": "The points of the window, from above and from two sides, in the world frame, and how "
              "far each is from its plane.",
    "residuals": "Left: residuals in units of sigma, before the kernel. Right: what the kernel leaves of "
                 "each point; it has a width for each of the axes to which normals belong.",
    "matrix": "Left: the information H of all poses, scaled to a unit diagonal. Right: how exactly "
              "the newest pose is known, in its body frame, with some factors left out; a bar to "
              "the right end is a direction that nothing holds."}
NAMES = {"registration": "registration", "motion": "motion terms", "prior": "marginalisation prior"}


def make_parser():
    parser = command_line.Parser(description=__doc__)
    parser.add_argument("result", type=pathlib.Path, help="output folder of trajlo_run")
    parser.add_argument("window", type=int, nargs="*", help="its number, as in windows.csv")
    return parser


def graphs_of(result, numbers):
    """The files of these windows, or of all."""
    folder = result / "windows"
    if numbers:
        return [folder / f"{number:06d}.json" for number in numbers]
    found = sorted(folder.glob("[0-9]*.json"))
    if not found:
        raise files.ReportError(f"{folder} holds no factor graphs: trajlo_run --inspect=N writes "
                                "them")
    return found


def draw_one(path):
    graph = window_graph.load(path)
    draws = {"points": figures_window.draw_points, "residuals": figures_window.draw_residuals,
             "matrix": figures_window.draw_matrix}
    figures = []
    for name, draw in draws.items():
        saved = theme.save(draw(graph, theme.PAGE_IN), path.with_name(f"{path.stem}_{name}"),
                           ("png", "svg", "pdf"), dpi=170)
        figures.append({"path": saved[0], "caption": CAPTIONS[name], "width": 1080})
    times_ns = graph.document["times_ns"]
    step_m, step_rad = graph.step_to_minimum()
    html = path.with_suffix(".html")
    files.write_atomically(html, page.render(
        "window.html", title=f"Window {graph.index}", source=str(path), graph=graph, names=NAMES,
        points=len(graph.points["segment"]), span_s=1e-9 * (times_ns[-1] - times_ns[0]),
        step_m=float(step_m), step_rad=float(step_rad), segments=list(graph.segments()),
        figures=figures))
    print(html)


def draw(arguments):
    theme.apply()
    for path in graphs_of(arguments.result, arguments.window):
        draw_one(path)
    return 0


if __name__ == "__main__":
    sys.exit(command_line.guarded(make_parser(), draw))
