# SPDX-License-Identifier: MIT
"""What figures of evaluated trajectories share. All poses are those of errors_<name>.csv: aligned
to the truth."""
import numpy as np

AXES = "xyz"


def with_gaps(times, *columns, factor=5.0, least_s=0.5):
    """A NaN row wherever the times jump, so that no line is drawn over a gap."""
    steps = np.diff(times)
    if not len(steps):
        return (times, *columns)
    jumps = np.flatnonzero(steps > max(factor * np.median(steps), least_s)) + 1
    return tuple(np.insert(np.asarray(column, dtype=float), jumps, np.nan, axis=0)
                 for column in (times, *columns))


def drawable(estimates):
    return [(index, estimate) for index, estimate in enumerate(estimates)
            if len(estimate.errors.get("t_s", ())) > 1]


def longest_truth(estimates):
    """Times and positions of the truth, from the estimate that covers most of it."""
    _, best = max(drawable(estimates), key=lambda item: len(item[1].times))
    return best.times, best.truth


def bounds(estimates):
    """Low and high corner of what is worth seeing: a diverged estimate must not shrink the rest."""
    _, truth = longest_truth(estimates)
    low, high = truth.min(axis=0), truth.max(axis=0)
    reach = 0.5 * max(high - low) + 0.1
    farthest = low - reach, high + reach
    for _, estimate in drawable(estimates):
        positions = np.clip(estimate.positions, *farthest)
        low, high = np.minimum(low, positions.min(axis=0)), np.maximum(high, positions.max(axis=0))
    margin = 0.04 * max(high - low)
    # A flat flight still gets a strip that can be read.
    least = 0.12 * max(high - low)
    middle, half = (low + high) / 2, np.maximum(high - low, least) / 2 + margin
    return middle - half, middle + half


def has_rotation(estimate):
    """Whether there are absolute errors of the rotation that say something."""
    if estimate.rotation_in_doubt:
        return False
    values = estimate.errors.get("rotation_error_deg")
    return isinstance(values, np.ndarray) and np.isfinite(values).any()


def legend_width(labels, width_in):
    """How many labels fit beside each other."""
    longest = max(len(label) for label in labels)
    return int(np.clip(width_in * 14 / (longest + 6), 1, len(labels)))


def legend_over(figure, axes):
    """A legend over the whole figure, which grows for it."""
    handles, labels = axes.get_legend_handles_labels()
    width, height = figure.get_size_inches()
    columns = legend_width(labels, width)
    legend_in = 0.1 + 0.16 * -(-len(labels) // columns)
    figure.set_size_inches(width, height + legend_in)
    figure.get_layout_engine().set(rect=(0.0, 0.0, 1.0, height / (height + legend_in)))
    figure.legend(handles, labels, loc="upper center", ncol=columns, frameon=False,
                  borderaxespad=0.1, columnspacing=1.2)


def legend_above(figure, axes):
    handles, labels = axes.get_legend_handles_labels()
    columns = legend_width(labels, figure.get_size_inches()[0])
    axes.legend(handles, labels, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=columns,
                frameon=False, borderaxespad=0.2, columnspacing=1.2)
