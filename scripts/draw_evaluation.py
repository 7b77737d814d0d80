#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws what trajlo_evaluate found: figures for papers, and a page with figures and tables.

  scripts/draw_evaluation.py DIR                  writes DIR/report.html and, in
                                                  DIR/figures, each figure as SVG, PDF and PNG
  scripts/draw_evaluation.py DIR --width page     figures as wide as both columns of a paper
DIR is the output folder of trajlo_evaluate. Needs Debian's python3-numpy, python3-matplotlib and
python3-jinja2.

Exit codes: 0 done, 1 wrong usage, 2 input unreadable, 5 output not writable.
"""
import pathlib
import sys

from trajlo_report import (command_line, evaluated, evaluation_words, figures_evaluation, files,
                           names, page, theme)

WIDTHS = {"column": theme.COLUMN_IN, "page": theme.PAGE_IN}


def make_parser():
    parser = command_line.Parser(description=__doc__)
    parser.add_argument("evaluation", type=pathlib.Path, help="output folder of trajlo_evaluate")
    parser.add_argument("--width", choices=WIDTHS, default="column", help="width of the figures")
    parser.add_argument("--output", type=pathlib.Path, help="the folder to write, in place of DIR")
    parser.add_argument("--title", default="Evaluation of trajectories")
    return parser


def draw(arguments):
    output = arguments.output or arguments.evaluation
    document, estimates = files.read_evaluation(arguments.evaluation)
    drawn = figures_evaluation.draw_all(estimates, output / "figures",
                                        width_in=WIDTHS[arguments.width])
    shown = {estimate.name for _, estimate in evaluated.drawable(estimates)}
    truth = document.get("truth", "")
    text = page.render(
        "evaluation.html", title=arguments.title, estimates=estimates, figures=drawn,
        conclusions=evaluation_words.conclusions(estimates),
        truth=truth.get("file", truth) if isinstance(truth, dict) else truth,
        undrawn=[item.name for item in estimates if item.name not in shown],
        settings=page.flatten(document.get("settings", {})),
        versions=page.flatten(document.get("versions", {})),
        warnings=document.get("warnings", []))
    report = output / "report.html"
    files.write_atomically(report, text)
    print(f"{report}: {names.counted(len(estimates), 'estimate')}, "
          f"{names.counted(len(drawn), 'figure')} in {output / 'figures'}")
    return 0


if __name__ == "__main__":
    sys.exit(command_line.guarded(make_parser(), draw))
