# SPDX-License-Identifier: MIT
"""What the figures of experiments share."""
import math

from matplotlib.lines import Line2D
from matplotlib.ticker import NullLocator
from matplotlib.transforms import ScaledTranslation

from trajlo_experiment.factors import LOG
from trajlo_report import theme
from trajlo_report.log_axis import plain_log

MARKERS = "D*sP^v"  # of marked settings
MARK_PT = 6.5       # from one to the next beside it
SHAPES = "os^vDP"   # of scenarios


def soften(axes):
    """The frame must not be louder than the data."""
    for side in axes.spines.values():
        side.set_linewidth(0.4)


def open_frame(axes):
    axes.spines[["top", "right"]].set_visible(False)


def mark_style(findings, name):
    """How a marked setting is drawn, the same in all figures."""
    shape = MARKERS[list(findings.marks).index(name) % len(MARKERS)]
    return {"ls": "", "marker": shape, "ms": 8.5 if shape == "*" else 5.5,
            "color": theme.METHODS[1], "mec": theme.PANEL, "mew": 0.7}


def draw_marks(axes, findings, places, transform=None, **how):
    """Marked settings, {name: (x, y)}; those at the same place lie beside each other."""
    count = {}
    for name, (x, y) in places.items():
        before = count.get((x, y), 0)
        count[x, y] = before + 1
        beside = ScaledTranslation(-MARK_PT * before / 72, 0, axes.figure.dpi_scale_trans)
        # Not with axes.plot, which would take the shift for a change of the axes.
        axes.add_artist(Line2D([x], [y], transform=(transform or axes.transData) + beside, zorder=5,
                               **how, **mark_style(findings, name)))


def mark_handles(findings, names):
    return [Line2D([], [], label=name, **mark_style(findings, name))
            for name in dict.fromkeys(names)]


def legend_columns(labels, width_in):
    """As many columns as fit; matplotlib fills them one after the other."""
    for columns in range(len(labels), 1, -1):
        lines = math.ceil(len(labels) / columns)
        widest = [max(map(len, labels[start:start + lines]))
                  for start in range(0, len(labels), lines)]
        if sum(0.5 + 0.055 * letters for letters in widest) <= width_in:
            return columns
    return 1


def below(figure, handles):
    """A legend below everything else, for which the figure grows."""
    if not handles:
        return
    width, height = figure.get_size_inches()
    columns = legend_columns([handle.get_label() for handle in handles], width)
    legend_in = 0.08 + 0.16 * math.ceil(len(handles) / columns)
    figure.set_size_inches(width, height + legend_in)
    share = legend_in / (height + legend_in)
    figure.get_layout_engine().set(rect=(0.0, share, 1.0, 1.0 - share))
    figure.legend(handles=handles, loc="lower center", ncol=columns, frameon=False,
                  borderaxespad=0.1, columnspacing=1.4, handletextpad=0.4)


def error_axis(axes, values):
    """A logarithmic axis of errors that shows all finite values, with room above for failures."""
    finite = [value for value in values if math.isfinite(value) and value > 0]
    if not finite:
        return
    low, high = min(finite), max(finite)
    span = max(math.log10(high / low), 0.3)
    low, high = low / 10 ** (0.13 * span), high * 10 ** (0.22 * span)
    axes.set_yscale("log")
    axes.set_ylim(low, high)
    plain_log(axes.yaxis, low, high)


def factor_axis(axes, factor, centers):
    """The x axis of a numeric factor with its levels as ticks."""
    if factor.scale == LOG:
        axes.set_xscale("log")
    if len(centers) <= 6:
        axes.set_xticks(centers, [f"{center:.3g}" for center in centers])
        axes.xaxis.set_minor_locator(NullLocator())
    elif factor.scale == LOG:
        plain_log(axes.xaxis, min(centers), max(centers))
    axes.set_xlabel(factor.label)
