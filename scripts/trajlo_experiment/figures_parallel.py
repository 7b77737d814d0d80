# SPDX-License-Identifier: MIT
"""Settings as lines through all factors to their error."""
import math
import textwrap

import matplotlib
from matplotlib import pyplot as plt
from matplotlib.colors import LogNorm
from matplotlib.lines import Line2D

from trajlo_experiment.drawing import below
from trajlo_experiment.factors import LOG, is_number, level_text
from trajlo_report import theme

HIGHLIGHTED = 0.1  # share of the settings whose lines stand out
LEAST_APART = 0.07  # of the height of an axis: two texts


def height_on_axis(findings, factor, level):
    """From 0 to 1 along the axis of a factor, and the ticks of that axis."""
    values = [item for item in dict.fromkeys(row[factor.name] for row in findings.design)
              if item is not None]
    if factor.numeric and all(map(is_number, values)):
        transform = math.log if factor.scale == LOG else float
        low, high = transform(min(values)), transform(max(values))
        return (transform(level) - low) / ((high - low) or 1.0)
    places = {value: place for place, value in enumerate(factor.levels)}
    return places[level] / max(len(places) - 1, 1)


def spread_ticks(ticks, least):
    """Ticks (height, text, ...) without those nearer than `least` to one that is kept; both ends
    are."""
    ticks = sorted(ticks)
    if len(ticks) < 3:
        return ticks
    kept = [ticks[0]]
    for tick in ticks[1:-1]:
        if tick[0] - kept[-1][0] >= least and ticks[-1][0] - tick[0] >= least:
            kept.append(tick)
    return [*kept, ticks[-1]]


def axis_ticks(findings, factor):
    values = [row[factor.name] for row in findings.design if row[factor.name] is not None]
    ticks = [(height_on_axis(findings, factor, value), level_text(value))
             for value in dict.fromkeys(values)]
    return spread_ticks(ticks, LEAST_APART) if factor.numeric else sorted(ticks)


def wrapped(title, count):
    """A title as narrow as the distance between two of `count` axes."""
    letters = max(8, int(theme.PAGE_IN * 13 / count))
    return textwrap.fill(title, letters, break_long_words=False)


def draw_lines(axes, findings, factors, points, norm, bound):
    """Each setting through its levels to its score; those up to `bound` stand out."""
    colors = matplotlib.colormaps[theme.ERROR_MAP].reversed()
    for name, row in sorted(points.items(), key=lambda item: -findings.scores[item[0]].score):
        score = findings.scores[name].score
        lost = not math.isfinite(score)
        heights = [height_on_axis(findings, factor, row[factor.name]) for factor in factors]
        heights.append(1.12 if lost else norm(min(score, norm.vmax)))
        color = theme.END if lost else colors(0.85 * norm(min(score, norm.vmax)))
        look = {"lw": 1.5, "alpha": 0.95, "zorder": 3} if score <= bound else {"lw": 0.5,
                                                                             "alpha": 0.45}
        axes.plot(range(len(heights)), heights, color=color, ls=":" if lost else "-", **look)
    return colors(0.0)


def draw_factor_axes(axes, findings, factors):
    for place, factor in enumerate(factors):
        axes.axvline(place, color=theme.TEXT, lw=0.7, zorder=4)
        for height, text in axis_ticks(findings, factor):
            axes.annotate(text, (place, height), textcoords="offset points", xytext=(-3, 0),
                          ha="right", va="center", fontsize=6.5, zorder=5,
                          bbox={"facecolor": theme.PANEL, "alpha": 0.85, "lw": 0, "pad": 0.6})


def draw_score_axis(axes, place, low, high, norm, fails):
    axes.axvline(place, color=theme.TEXT, lw=0.7)
    ticks = [low, *(value for value in (0.5, 0.7, 1, 1.5, 2, 3, 5, 10, 20, 50)
                    if 1.12 * low < value < 0.9 * high), high]
    ticks = [(float(norm(value)), f"{value:.2g}", theme.TEXT) for value in ticks]
    ticks = spread_ticks(ticks, LEAST_APART) + ([(1.12, "fails", theme.END)] if fails else [])
    for height, text, color in ticks:
        axes.annotate(text, (place, height), textcoords="offset points", xytext=(4, 0),
                      va="center", fontsize=6.5, color=color)


def draw_parallel(findings):
    """Each setting is a line through its levels to its error; the best stand out."""
    factors = [factor for factor in findings.study.factors if len(findings.bins(factor)) > 1]
    points = {row["point"]: row for row in findings.design if row["point"] in findings.scores
              and all(row[factor.name] is not None for factor in factors)}
    finite = sorted(score for score in (findings.scores[name].score for name in points)
                    if math.isfinite(score))
    if len(factors) < 2 or len(finite) < 3:
        return None
    low, high = finite[0], min(finite[-1], 10 * finite[0])
    norm = LogNorm(low, max(high, 1.01 * low))
    best = max(3, math.ceil(HIGHLIGHTED * len(finite)))
    names = max((len(axis_ticks(findings, factor)) for factor in factors if not factor.numeric),
                default=0)
    figure, axes = plt.subplots(figsize=(theme.PAGE_IN, max(2.5, 0.8 + 0.13 * names)),
                                constrained_layout=True)
    best_color = draw_lines(axes, findings, factors, points, norm, bound=finite[best - 1])
    draw_factor_axes(axes, findings, factors)
    last, fails = len(factors), len(finite) < len(points)
    draw_score_axis(axes, last, low, high, norm, fails)
    titles = [*(factor.label for factor in factors), findings.ratio_label]
    axes.set_xticks(range(last + 1), [wrapped(title, last + 1) for title in titles])
    axes.set(xlim=(-0.35, last + 0.35), ylim=(-0.06, 1.2), yticks=[])
    axes.tick_params(length=0)
    axes.grid(False)
    axes.spines[:].set_visible(False)
    handles = [Line2D([], [], color=best_color, lw=1.5,
                      label=f"the best {best} of {len(finite)} settings")]
    if fails:
        handles.append(Line2D([], [], color=theme.END, ls=":", lw=1, label="fails on a recording"))
    below(figure, handles)
    return figure
