# SPDX-License-Identifier: MIT
"""Ticks of logarithmic axes as people write numbers."""
import math

from matplotlib.ticker import FixedFormatter, FixedLocator, MaxNLocator, NullLocator


def log_ticks(low, high):
    """Round numbers between two others, evenly enough on a logarithmic axis."""
    decades = math.log10(high / low)
    steps = ((1,) if decades > 3 else (1, 3) if decades > 1.5 else (1, 2, 5) if decades > 0.8
             else (1, 1.5, 2, 3, 4, 5, 7))
    powers = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    ticks = [step * 10.0**power for power in powers for step in steps]
    inside = [tick for tick in ticks if low <= tick <= high]
    if len(inside) < 3:
        inside = [tick for tick in MaxNLocator(4).tick_values(low, high) if low <= tick <= high]
    return inside


def plain_log(axis, low, high):
    """Ticks of a logarithmic axis as people write numbers: 0.02, 0.05, 0.1, ..."""
    ticks = log_ticks(low, high)
    axis.set_major_locator(FixedLocator(ticks))
    axis.set_major_formatter(FixedFormatter([f"{tick:.4g}" for tick in ticks]))
    axis.set_minor_locator(NullLocator())
