# SPDX-License-Identifier: MIT
"""Colours and sizes of all figures: `light` for papers, `dark` for screens.

The colours of methods are those of Okabe and Ito (light), which people with any of the common
colour blindnesses can tell apart; line styles differ as well.
"""
import dataclasses
import pathlib

import matplotlib
import matplotlib.pyplot as plt

COLUMN_IN = 3.5  # one column of a two-column paper
PAGE_IN = 7.16   # both


@dataclasses.dataclass(frozen=True)
class Theme:
    name: str
    background: str
    panel: str
    text: str
    grid: str
    path: str
    truth: str
    start: str
    end: str
    methods: tuple
    stages: dict
    error_map: str  # the colour map of errors


LIGHT = Theme(
    name="light", background="#ffffff", panel="#ffffff", text="#1f2328", grid="#d8dee4",
    path="#0072b2", truth="#000000", start="#009e73", end="#d55e00",
    methods=("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"),
    stages={"segment": "#999999", "associate": "#0072b2", "solve": "#e69f00",
            "marginalize": "#cc79a7", "map": "#009e73"},
    error_map="viridis_r")
DARK = Theme(
    name="dark", background="#0d1117", panel="#11161d", text="#c9d1d9", grid="#2b323b",
    path="#ffffff", truth="#ff7b72", start="#56d364", end="#f85149",
    methods=("#58a6ff", "#f2cc60", "#56d364", "#bc8cff", "#ff9e64", "#8bd5ca"),
    stages={"segment": "#8b949e", "associate": "#58a6ff", "solve": "#f2cc60",
            "marginalize": "#bc8cff", "map": "#56d364"},
    error_map="plasma")
THEMES = {theme.name: theme for theme in (LIGHT, DARK)}

LINE_STYLES = ("-", "--", "-.", ":")


def apply(theme, font_size=8):
    """Makes `theme` the look of all figures that are made from here on."""
    plt.rcdefaults()
    matplotlib.use("Agg")  # no display is needed
    plt.rcParams.update({
        "figure.facecolor": theme.background, "axes.facecolor": theme.panel,
        "savefig.facecolor": theme.background, "text.color": theme.text,
        "axes.labelcolor": theme.text, "axes.edgecolor": theme.text, "xtick.color": theme.text,
        "ytick.color": theme.text, "grid.color": theme.grid, "grid.linewidth": 0.5,
        "axes.grid": True, "axes.axisbelow": True, "axes.linewidth": 0.6,
        "font.size": font_size, "axes.labelsize": font_size, "axes.titlesize": font_size,
        "legend.fontsize": font_size - 1, "xtick.labelsize": font_size - 1,
        "ytick.labelsize": font_size - 1, "legend.facecolor": theme.panel,
        "legend.edgecolor": theme.grid, "legend.labelcolor": theme.text, "lines.linewidth": 1.1,
        # The same input gives the same bytes.
        "svg.hashsalt": "trajlo",
    })


def method_style(theme, index):
    """Colour and line style of the method with this index."""
    return {"color": theme.methods[index % len(theme.methods)],
            "linestyle": LINE_STYLES[(index // len(theme.methods)) % len(LINE_STYLES)]}


def save(figure, stem, formats=("svg", "png"), dpi=250):
    """Writes stem.svg, stem.png, ... and closes the figure; returns the paths in that order."""
    stem = pathlib.Path(stem)
    paths = []
    for kind in formats:
        path = stem.with_name(f"{stem.name}.{kind}")
        metadata = {"Date": None} if kind == "svg" else {}
        figure.savefig(path, dpi=dpi, metadata=metadata)
        paths.append(path)
    plt.close(figure)
    return paths
