# SPDX-License-Identifier: MIT
"""How far each factor alone moves the error away from that of a centre."""
import math

from matplotlib import pyplot as plt
from matplotlib.lines import Line2D

from trajlo_experiment import analysis
from trajlo_experiment.drawing import below, open_frame
from trajlo_experiment.experiment import CENTER
from trajlo_report import theme
from trajlo_report.log_axis import plain_log


def swings(findings):
    """(text, [(level, score)]) of each factor with numbers, of each level that is a name."""
    found = []
    for factor in findings.study.factors:
        ends = []
        for item in findings.bins(factor):
            point = item.rows[0]["point"]
            if CENTER not in analysis.marks_of(item.rows[0]) and point in findings.scores:
                ends.append((item.label, findings.scores[point]))
        if factor.numeric:
            found.append((factor.label, ends))
        else:
            found += [(f"{factor.label}: {text}", [("", score)]) for text, score in ends]
    return [(text, ends) for text, ends in found if ends]


def draw_tornado(findings):
    """How far each factor moves the error away from that of the centre; the widest on top."""
    items = swings(findings)
    if not items or CENTER not in findings.marks:
        return None

    def width(item):
        return max(abs(math.log(ranked.score)) if ranked.score < math.inf else 1e9 + ranked.failed
                   for _, ranked in item[1])

    items.sort(key=width)
    finite = [value for _, ends in items for _, ranked in ends for value in
              (ranked.score, ranked.low, ranked.high) if math.isfinite(value)] + [1.0]
    span = max(math.log10(max(finite) / min(finite)), 0.1)
    low, high = min(finite) / 10 ** (0.18 * span), max(finite) * 10 ** (0.3 * span)
    figure, axes = plt.subplots(figsize=(theme.PAGE_IN * 0.75, 0.23 * len(items) + 0.6),
                                constrained_layout=True)
    for place, (_, ends) in enumerate(items):
        draw_swing(axes, place, ends, (low, high))
    axes.axvline(1.0, color=theme.TEXT, lw=0.8)
    axes.set_yticks(range(len(items)), [text for text, _ in items])
    axes.set(xscale="log", xlim=(low, high), ylim=(-0.7, len(items) - 0.3))
    plain_log(axes.xaxis, low, high)
    axes.set_xlabel(f"{findings.ratio_label}, geometric mean over scenarios and seeds")
    axes.grid(axis="y", visible=False)
    axes.tick_params(axis="y", length=0)
    open_frame(axes)
    below(figure, [plt.Rectangle((0, 0), 1, 1, color=theme.METHODS[2], label="better"),
                   plt.Rectangle((0, 0), 1, 1, color=theme.METHODS[1], label="worse"),
                   *([Line2D([], [], color=theme.TEXT, lw=0.8, label="95 % over seeds")]
                     if findings.has_intervals else []),
                   *([Line2D([], [], ls="", marker="x", color=theme.END, label="runs that failed")]
                     if findings.failures else [])])
    return figure


def draw_swing(axes, place, levels, limits):
    finite = [(text, ranked) for text, ranked in levels if math.isfinite(ranked.score)]
    best = min(finite, key=lambda item: item[1].score, default=None)
    worst = max(finite, key=lambda item: item[1].score, default=None)
    # Where both ends are on one side, the farther one is the swing.
    shown = [best] if best and best[1].score < 1.0 else []
    shown += [worst] if worst and worst[1].score >= 1.0 else []
    for text, ranked in shown:
        better = ranked.score < 1.0
        axes.barh(place, ranked.score - 1.0, left=1.0, height=0.62,
                  color=theme.METHODS[2] if better else theme.METHODS[1], alpha=0.85)
        if math.isfinite(ranked.high):
            axes.plot([ranked.low, ranked.high], [place, place], color=theme.TEXT, lw=0.8)
        ends = [value for value in (ranked.score, ranked.low, ranked.high) if math.isfinite(value)]
        edge = min(ends) if better else max(ends)
        axes.annotate(text, (edge, place), textcoords="offset points",
                      xytext=(-3 if better else 3, 0), ha="right" if better else "left",
                      va="center", fontsize=6)
    failed = [f"{text} ({ranked.failed})" if text else str(ranked.failed)
              for text, ranked in levels if ranked.failed]
    if failed:
        axes.annotate("× " + ", ".join(failed), (limits[1], place), ha="right", va="center",
                      fontsize=6, color=theme.END)
