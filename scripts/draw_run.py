#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""One self-contained page of a run: a summary, map and path in 3-D, figures, all numbers.

  scripts/draw_run.py RESULT                          writes RESULT/run.html, and the figures as
                                                      SVG, PDF and PNG into RESULT/figures
  scripts/draw_run.py RESULT --evaluation EVALUATION  with what trajlo_evaluate found about it
  scripts/draw_run.py RESULT --output PAGE --points 200000
                                                      a smaller page, in another folder
RESULT is the output folder of trajlo_run; of an interrupted or lost run, what is there is shown.
The page needs no network; a browser with WebGL 2 turns the map. Needs Debian's python3-numpy,
python3-scipy, python3-matplotlib, python3-jinja2, python3-yaml and libjs-three.

Exit codes: 0 done, 1 wrong usage, 2 input unreadable, 5 output not writable.
"""
import pathlib
import sys

from trajlo_report import command_line, files, run_page, view_cloud


def make_parser():
    parser = command_line.Parser(description=__doc__)
    parser.add_argument("result", type=pathlib.Path, help="the output folder of trajlo_run")
    parser.add_argument("--evaluation", type=pathlib.Path, help="output folder of trajlo_evaluate")
    parser.add_argument("--output", type=pathlib.Path, help="the folder to write; default: RESULT")
    parser.add_argument("--points", type=command_line.positive, default=view_cloud.BUDGET,
                        help="the most points in the 3-D view; default: %(default)s")
    parser.add_argument("--title", help="in place of the recording's name")
    return parser


def draw(arguments):
    output = arguments.output or arguments.result
    if not arguments.result.is_dir():
        raise files.ReportError(f"{arguments.result} is not a folder")
    if not any((arguments.result / name).is_file() for name in ("run.json", "trajectory.tum")):
        raise files.ReportError(f"{arguments.result} holds no result of trajlo_run (run.json)")
    file, shown = run_page.write(arguments.result, output, arguments.evaluation, arguments.title,
                                 arguments.points)
    figures = len(shown["figures"]) + len(shown["evaluation_figures"])
    print(f"{file}: {file.stat().st_size / 1e6:.1f} MB, {figures} figures. {shown['verdict']}")
    return 0


if __name__ == "__main__":
    sys.exit(command_line.guarded(make_parser(), draw))
