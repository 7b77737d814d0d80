# SPDX-License-Identifier: MIT
"""Colours and sizes of all figures and pages.

The colours of methods are those of Okabe and Ito, which people with any of the common colour
blindnesses can tell apart; line styles differ as well.
"""
import pathlib

import matplotlib
import matplotlib.pyplot as plt

from trajlo_report import files

COLUMN_IN = 3.5  # one column of a two-column paper
PAGE_IN = 7.16   # both

BACKGROUND = "#ffffff"
PANEL = "#ffffff"
TEXT = "#1f2328"
QUIET = "#59636e"
GRID = "#d8dee4"
PATH = "#0072b2"
TRUTH = "#000000"
START = "#009e73"
END = "#d55e00"
FLAG = "#d1242f"
METHODS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9")
STAGES = {"segment": "#999999", "associate": "#0072b2", "solve": "#e69f00",
          "marginalize": "#cc79a7", "map": "#009e73"}
ERROR_MAP = "viridis_r"  # the colour map of errors
LINE_STYLES = ("-", "--", "-.", ":")

# Figures for papers, for pages, and for whatever takes neither.
FORMATS = ("svg", "pdf", "png")


def apply(font_size=8):
    """Makes this the look of all figures that are made from here on."""
    plt.rcdefaults()
    matplotlib.use("Agg")  # no display is needed
    plt.rcParams.update({
        "figure.facecolor": BACKGROUND, "axes.facecolor": PANEL, "savefig.facecolor": BACKGROUND,
        "text.color": TEXT, "axes.labelcolor": TEXT, "axes.edgecolor": TEXT, "xtick.color": TEXT,
        "ytick.color": TEXT, "grid.color": GRID, "grid.linewidth": 0.5,
        "axes.grid": True, "axes.axisbelow": True, "axes.linewidth": 0.6,
        "font.size": font_size, "axes.labelsize": font_size, "axes.titlesize": font_size,
        "legend.fontsize": font_size - 1, "xtick.labelsize": font_size - 1,
        "ytick.labelsize": font_size - 1, "legend.facecolor": PANEL,
        "legend.edgecolor": GRID, "legend.labelcolor": TEXT, "lines.linewidth": 1.1,
        # Text stays text, that an editor can change and a reader can search for.
        "svg.fonttype": "none", "pdf.fonttype": 42,
        # The same input gives the same bytes.
        "svg.hashsalt": "trajlo",
    })


def method_style(index):
    """Colour and line style of the method with this index."""
    return {"color": METHODS[index % len(METHODS)],
            "linestyle": LINE_STYLES[(index // len(METHODS)) % len(LINE_STYLES)]}


def save(figure, stem, formats=FORMATS, dpi=250):
    """Writes stem.svg, stem.pdf, ... and closes the figure; returns the paths in that order."""
    stem = pathlib.Path(stem)
    paths = []
    undated = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}
    for kind in formats:
        path = stem.with_name(f"{stem.name}.{kind}")
        with files.writing(path):
            figure.savefig(path, dpi=dpi, metadata=undated.get(kind, {}))
        # To place all texts takes as long as to draw them; once is enough for all formats.
        figure.set_layout_engine("none")
        paths.append(path)
    plt.close(figure)
    return paths
