#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws the speed of trajectories over time, against that of the truth.

  scripts/draw_speeds.py speeds.svg truth=rec/truth.tum ours=result/trajectory.tum
Each argument after the figure is NAME=FILE in TUM's format; the first one is drawn as the truth.
Needs Debian's python3-numpy and python3-matplotlib.

Exit codes: 0 done, 1 wrong usage, 2 input unreadable, 5 output not writable.
"""
import argparse
import pathlib
import sys

import matplotlib.pyplot as plt
import numpy as np

from trajlo_report import command_line, files, theme

SMOOTHING_S = 0.2


def speeds(path):
    """Middles of spans of SMOOTHING_S, and the mean speed over each (m/s)."""
    times, positions, _ = files.read_poses(path)
    at = np.arange(times[0], times[-1], SMOOTHING_S)
    places = np.column_stack([np.interp(at, times, positions[:, axis]) for axis in range(3)])
    way = np.linalg.norm(np.diff(places, axis=0), axis=1)
    return (at[:-1] + at[1:]) / 2, way / SMOOTHING_S


def figure_file(text):
    if pathlib.Path(text).suffix.lstrip(".").lower() not in theme.FORMATS:
        raise argparse.ArgumentTypeError(f"'{text}' does not end in .svg, .pdf or .png")
    return text


def named_file(text):
    name, separator, path = text.partition("=")
    if not separator:
        raise argparse.ArgumentTypeError(f"'{text}' is not NAME=FILE")
    return name, path


def make_parser():
    parser = command_line.Parser(description=__doc__)
    parser.add_argument("figure", type=figure_file, help="SVG, PDF or PNG to write")
    parser.add_argument("trajectories", type=named_file, nargs="+", metavar="NAME=FILE")
    return parser


def draw(arguments):
    theme.apply()
    figure, axes = plt.subplots(figsize=(theme.PAGE_IN, 2.6), layout="constrained")
    start_s = None
    for index, (name, path) in enumerate(arguments.trajectories):
        times, speed = speeds(path)
        start_s = times[0] if start_s is None else start_s
        style = ({"color": theme.TRUTH, "linewidth": 3, "alpha": 0.3} if index == 0
                 else theme.method_style(index - 1))
        axes.plot(times - start_s, speed, label=name, **style)
    axes.set_xlabel("time [s]")
    axes.set_ylabel("speed [m/s]")
    axes.legend(frameon=False)
    with files.writing(arguments.figure):
        figure.savefig(arguments.figure, dpi=200)
    return 0


if __name__ == "__main__":
    sys.exit(command_line.guarded(make_parser(), draw))
