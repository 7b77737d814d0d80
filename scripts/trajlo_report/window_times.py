# SPDX-License-Identifier: MIT
"""Whether solvers differ in the time that they take for a window, or by no more than noise does.

All variants solve the same windows, so times are compared window by window."""
import math

import numpy as np

# Two runs of one solver differ by a few percent: the order in which variants come to a window, and
# what the computer does besides, count that much.
NOISE = 0.1


def by_window(table, name):
    """Times of a variant by window, ms, from the columns of lockstep.csv."""
    return {window: ms for window, variant, ms in
            zip(table["window"], table["variant"], table["total_ms"]) if variant == name}


def chance_at_most(count, of):
    """The probability of at most this many heads in so many throws of a coin."""
    return sum(math.comb(of, k) for k in range(count + 1)) / 2**of


def has_a_winner(ratios):
    """A sign test: whether one of two is faster in more windows than chance explains (95 %). Of fewer
    than six windows, in all of them."""
    exceptions = min(int((ratios > 1).sum()), int((ratios < 1).sum()))
    same = int((ratios == 1).sum())
    return exceptions + same == 0 or chance_at_most(exceptions + same, len(ratios)) <= 0.025


def alike(table, name, other):
    """True if the median ratio is nearer to 1 than noise, or no side wins more often than chance."""
    first, second = by_window(table, name), by_window(table, other)
    windows = [window for window in first if first[window] > 0 and second.get(window, 0) > 0]
    if name == other or not windows:
        return True
    ratios = np.array([second[window] / first[window] for window in windows])
    apart = max(np.median(ratios), 1 / np.median(ratios)) - 1
    return apart < NOISE or not has_a_winner(ratios)
