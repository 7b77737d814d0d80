# SPDX-License-Identifier: MIT
"""What all figures of an experiment look at: rows, errors, factors and marks."""
import dataclasses
import math

import numpy as np

from trajlo_batch import results
from trajlo_experiment import analysis, designs
from trajlo_experiment.experiment import CENTER
from trajlo_experiment.factors import LOG, is_number, level_text
from trajlo_report.names import decimals_of

# How a metric is written on an axis: name, unit, what it is multiplied by, decimals in a cell.
SHOWN = {"ate_rmse_m": ("position error, RMSE", "cm", 100.0, 1),
         "ate_rotation_rmse_deg": ("rotation error, RMSE", "°", 1.0, 2),
         "rpe_1m_rmse_m": ("error over 1 m, RMSE", "cm", 100.0, 2),
         "rpe_10m_rmse_m": ("error over 10 m, RMSE", "cm", 100.0, 1),
         "kitti_translation_percent": ("relative translation error", "%", 1.0, 2)}
BINS, PER_BIN = 6, 3  # of a range that was sampled: the most, and the least settings in one


@dataclasses.dataclass(frozen=True)
class Bin:
    """The rows in which a factor has one level, or lies in a part of its range."""
    label: str
    center: object
    rows: tuple


class Findings:
    def __init__(self, study, rows):
        self.study = study
        self.metric = study.metric
        # What was made with other options than the rest is not compared with it.
        ended = [row for row in rows if row["result"] != results.UNFINISHED and not row["outdated"]]
        self.has_ended = len(ended) == len(rows)
        self.left_out = analysis.recordings_without_error(ended, self.metric)
        self.rows = [row for row in ended if analysis.recording_of(row) not in self.left_out]
        self.groups = list(dict.fromkeys(row["group"] for row in self.rows))
        self.design = [row for row in self.rows if row["in_design"]]
        self.failures = sum(row["result"] == results.FAILED for row in self.rows)
        self.marks = {mark: row for row in self.rows for mark in analysis.marks_of(row)}
        self.reference = analysis.reference_of(self.rows, self.metric, study.reference)
        name, self.unit, self.multiplier, self.decimals = SHOWN.get(
            self.metric, (self.metric.replace("_", " "), "", 1.0, decimals_of(self.metric)))
        self.label = f"{name} [{self.unit}]" if self.unit else name
        by_name = {ranked.point: ranked for ranked in self.ranked()}
        self.scores = {row["point"]: by_name[row["point"]] for row in self.rows
                       if row["point"] in by_name}

    @property
    def has_intervals(self):
        """Whether every scenario has the seeds to say how far results scatter."""
        return analysis.enough_seeds(list(self.reference.errors))

    @property
    def sampled(self):
        return self.study.design.kind in designs.SAMPLED

    @property
    def compared_text(self):
        """ ", on 5 of 6 recordings" where not all of them could be compared."""
        used, count = len(self.reference.errors), self.reference.recordings
        return f", on {used} of {count} recordings" if 0 < used < count else ""

    @property
    def ratio_label(self):
        if not self.reference.errors:
            return "error"
        other = (f"error of {self.study.reference}" if self.reference.is_marked else
                 "median over settings")
        return f"error / {other}{self.compared_text}"

    def ranked(self):
        return analysis.rank(self.rows, self.metric, self.study.reference)

    def text(self, value):
        """An error as cells show it; × is a failure."""
        if not math.isfinite(value):
            return "×" if math.isinf(value) else "–"
        return f"{value:.{self.decimals + (value < 1.0)}f}"

    def error(self, row):
        """In the unit of the figures."""
        return self.multiplier * analysis.error_of(row, self.metric)

    def errors(self, rows, group=None):
        return [self.error(row) for row in rows if group in (None, row["group"])]

    def rows_about(self, factor):
        """The rows that say what this factor does: in a design of one at a time, those in which
        nothing else differs from the centre."""
        if self.study.design.kind != designs.ONE_AT_A_TIME:
            return self.design
        points = {point.name: point for point in self.study.points}
        center = next(point for point in points.values() if CENTER in point.marks)

        def others(point):
            return {name: level for name, level in point.levels.items() if name != factor.name}

        return [row for row in self.design
                if others(points[row["point"]]) == others(center)]

    def bins(self, factor, rows=None):
        """Bins of a factor in the order of its axis."""
        rows = self.rows_about(factor) if rows is None else rows
        rows = [row for row in rows if row[factor.name] is not None]
        values = list(dict.fromkeys(row[factor.name] for row in rows))
        if factor.numeric and all(map(is_number, values)):
            values.sort()
            if self.sampled and factor.is_range:
                return range_bins(factor, rows, values)
        else:
            order = {level: place for place, level in enumerate(factor.levels)}
            values.sort(key=lambda value: order.get(value, len(order)))
        return [Bin(level_text(value), value,
                    tuple(row for row in rows if row[factor.name] == value)) for value in values]


def range_bins(factor, rows, values):
    """Parts of a sampled range with as many of its values each. In every one are settings enough that
    what else differs between them has no great part in their mean."""
    points = len({row["point"] for row in rows})
    found = []
    for part in np.array_split(values, min(BINS, max(2, points // PER_BIN), len(values))):
        low, high = part[0].item(), part[-1].item()
        center = math.sqrt(low * high) if factor.scale == LOG else (low + high) / 2
        label = (level_text(low) if low == high else
                 "–".join(level_text(end if factor.whole else float(f"{end:.2g}"))
                          for end in (low, high)))
        found.append(Bin(label, center, tuple(row for row in rows
                                              if low <= row[factor.name] <= high)))
    return found


def place_among(factor, level, levels):
    """Where a value lies on an axis with evenly spaced levels; nothing if it lies outside."""
    if not is_number(level):
        return float(levels.index(level)) if level in levels else None
    if not all(map(is_number, levels)):
        return None
    transform = np.log if factor.scale == LOG else np.asarray
    tolerance = 1e-9 * max(abs(value) for value in levels)
    if not levels[0] - tolerance <= level <= levels[-1] + tolerance:
        return None
    return float(np.interp(transform(level), transform(np.array(levels, dtype=float)),
                           range(len(levels))))
