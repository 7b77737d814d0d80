# SPDX-License-Identifier: MIT
"""Tables of results. As in the paper: the best is bold, the best of each category underlined,
`x` is a divergence, `-` is not there."""
import dataclasses
import math
import re
import statistics

from trajlo_batch import results, table_formats
from trajlo_report import names

X, ABSENT, PENDING, DOUBT, OUTDATED = "x", "-", "…", "!", "outdated"
UNSURE = "?"
GOOD = (results.OK, results.NO_TRUTH)
# What readers see in the place of a column of results.csv.
METRICS = {"ate_rmse_m": "absolute position error, RMSE [m]",
           "ate_rotation_rmse_deg": "absolute rotation error, RMSE [°]",
           "kitti_translation_percent": "KITTI's relative translation error [%]",
           "kitti_rotation_deg_per_m": "KITTI's relative rotation error [°/m]",
           "distance_to_start_m": "distance of the end from the start [m]"}
FROM_TRUTH = re.compile("(ate|rpe|kitti)_.*|completeness|pairs|path_length_m|time_offset_s")
# Of other columns, such as the length of the path, neither the least nor the most is the best.
LARGER_IS_BETTER = re.compile("times_real_time|inlier_share|completeness|pairs|lost_at_s"
                              "|smallest_eigenvalue_.*")
SMALLER_IS_BETTER = re.compile("(ate|rpe|kitti|share|cpu|wall|estimation_ms)_.*|poses_flagged"
                               "|peak_memory_mb|distance_to_start_m|rejected_steps"
                               "|(rounds|iterations)_per_window")


@dataclasses.dataclass
class Cell:
    text: str
    value: float = math.nan
    best: bool = False
    category_best: bool = False
    note: str = ""     # what a reader sees who asks
    folder: str = ""   # of the run, where it is one


@dataclasses.dataclass
class Line:
    """One approach: its category, label and cells."""
    label: str
    category: str = ""
    sensors: str = ""
    ours: bool = True
    cells: list = dataclasses.field(default_factory=list)


@dataclasses.dataclass
class Table:
    """Cells by approach; `transposed` prints a row a column."""
    caption: str
    columns: list
    lines: list
    notes: list = dataclasses.field(default_factory=list)
    transposed: bool = False


def published_cell(text):
    return Cell(text, math.nan if text in (X, ABSENT) else float(text))


def result_cell(rows, suite, decimals):
    """The cell of all seeds of one sequence with one configuration."""
    if not rows:
        return Cell(ABSENT)
    note = "; ".join(f"{row['sequence']}: {row['result']}, {row['reason']}"
                     for row in rows if row["result"] not in GOOD or results.in_doubt(row))
    old = [row for row in rows if row.get("outdated")]
    unsure = [row for row in rows if row.get("evaluation_warnings")
              and FROM_TRUTH.fullmatch(suite.metric)]
    note = "; ".join([*([note] if note else []), *(
        f"{row['sequence']}: {row['evaluation_warnings']}" for row in unsure), *(
        f"{row['sequence']}: {OUTDATED}, changed since: {row['outdated']}" for row in old)])
    folder = rows[0]["folder"]
    values = [row[suite.metric] for row in rows
              if row["result"] in GOOD and row.get(suite.metric) is not None]
    failed = sum(row["result"] == results.FAILED for row in rows)
    if not values and not failed:
        pending = any(row["result"] in (results.UNFINISHED, results.NOT_ASKED) for row in rows)
        return Cell(PENDING if pending else ABSENT, note=note)
    ended = len(values) + failed
    share = f" ({ended} of {len(rows)})" if ended < len(rows) else ""
    share += f" ({OUTDATED})" if len(old) == len(rows) else f" ({len(old)} {OUTDATED})" if old else ""
    if not values:
        share = f" {UNSURE}{share}" if unsure else share
        return Cell(f"{X}{share}", note=note, folder=folder)
    value = {"median": statistics.median, "mean": statistics.fmean, "max": max}[
        suite.over_seeds](values)
    text = f"{value:.{decimals}f}"
    if len(values) > 1:
        spread = f"{min(values):.{decimals}f} to {max(values):.{decimals}f}, {len(values)} seeds"
        note = f"{spread}; {note}" if note else spread
    if any(map(results.in_doubt, rows)):
        text += f" {DOUBT}"
    if unsure:
        text += f" {UNSURE}"
    if failed:
        text += f" ({failed} {X})"
    # One that fails on a seed is not the best, however good the others are; of one that has not
    # ended on all of them, or with what is asked for now, nobody knows yet.
    return Cell(text + share, math.nan if failed or share else value, note=note, folder=folder)


def average_cell(cells, decimals):
    """The mean over all sequences; over some of them, such as those without an x, it says so, and
    is not compared."""
    values = [cell.value for cell in cells if not math.isnan(cell.value)]
    if not values:
        return Cell(ABSENT)
    text = f"{statistics.fmean(values):.{decimals}f}"
    used = [cell.text for cell in cells if not math.isnan(cell.value)]
    text += "".join(f" {sign}" for sign in (DOUBT, UNSURE) if any(sign in said for said in used))
    if len(values) < len(cells):
        return Cell(f"{text} ({len(values)} of {len(cells)})")
    return Cell(text, statistics.fmean(values))


def means_over_the_same(table, average, groups, decimals):
    """Notes: where ours leaves sequences out of its average, the means of all over the rest."""
    places = [index for index, column in enumerate(table.columns) if column in groups]
    absent = {line.label: [index for index in places if math.isnan(line.cells[index].value)]
              for line in table.lines if line.ours}
    notes = []
    for left_out in {tuple(left_out): None for left_out in absent.values()}:
        used = [index for index in places if index not in left_out]
        means = [(table_formats.heading(table, line), [line.cells[index].value for index in used])
                 for line in table.lines]
        means = [f"{label} {statistics.fmean(values):.{decimals}f}" for label, values in means
                 if values and not any(map(math.isnan, values))]
        if left_out and len(means) > 1:
            part = [table.columns[index] for index in min(left_out, used, key=len)]
            word = "over" if len(used) < len(left_out) else "without"
            notes.append(f"{average} {word} {', '.join(part)}: {', '.join(means)}.")
    return notes


def mark(lines, metric):
    """Marks the best of each column, and of each category when there are several: by all of their
    digits, also where numbers are printed alike."""
    categories = {line.category for line in lines}
    for column in zip(*(line.cells for line in lines)):
        cells = list(zip(lines, column))
        best_of(cells, "best", metric)
        for category in categories if len(categories) > 1 else ():
            best_of([item for item in cells if item[0].category == category], "category_best",
                    metric)


def best_of(cells, attribute, metric):
    best = (max if LARGER_IS_BETTER.fullmatch(metric) else
            min if SMALLER_IS_BETTER.fullmatch(metric) else None)
    values = [cell.value for _, cell in cells if not math.isnan(cell.value)]
    for _, cell in cells:
        if best and values and cell.value == best(values):
            setattr(cell, attribute, True)


def seeds_of_cells(rows):
    """How many seeds each cell has: {(configuration, group): count}; none of a real recording."""
    counts = {}
    for row in rows:
        cell = row["configuration"], row["group"]
        counts[cell] = counts.get(cell, 0) + bool(row.get("seed"))
    return counts


def say_fewer_seeds(cell, count, most):
    """A cell of fewer seeds than others says so."""
    if 0 < count < most and cell.text not in (ABSENT, PENDING):
        cell.text += f" ({names.counted(count, 'seed')})"


def seeds_note(suite, rows):
    """What the values are of; nothing where no cell has more than one seed."""
    counts = set(seeds_of_cells(rows).values())
    least, most = min(counts - {0}, default=0), max(counts, default=0)
    if most < 2:
        return []
    said = f"of {most} seeds" if least == most else (
        f"over the seeds of its sequence ({least} to {most}); cells based on fewer seeds say so")
    real = "; real recordings have no seeds" if 0 in counts else ""
    return [f"Each value is the {suite.over_seeds} {said}{real}; (1 x) says that one of them "
            f"failed, (1 of {most}) that only one has ended."]


def doubt_note(lines):
    """What the sign at a value means, where there is one."""
    marked = any(DOUBT in cell.text for line in lines if line.ours for cell in line.cells)
    return [f"{DOUBT}: a run behind this value ended with exit code 3: a part of its input was "
            "damaged, left out or in doubt; results.csv says which."] if marked else []


def unsure_note(lines):
    """The same for what trajlo_evaluate has doubts about."""
    marked = any(UNSURE in cell.text for line in lines if line.ours for cell in line.cells)
    return [f"{UNSURE}: trajlo_evaluate warns about the comparison with the truth, such as about units, "
            "axes or clocks; results.csv says why in evaluation_warnings."] if marked else []


def mark_notes(lines):
    return doubt_note(lines) + unsure_note(lines) + outdated_note(lines)


def outdated_note(lines):
    """What that word at a value means, where it is."""
    marked = any(OUTDATED in cell.text for line in lines if line.ours for cell in line.cells)
    return [f"{OUTDATED}: what the run was made with has changed since, as results.csv says in the "
            "column of that name; such values are not compared."] if marked else []


def our_lines(suite, rows, columns, decimals, average=""):
    lines, groups = [], {sequence.group for sequence in suite.sequences}
    seeds = seeds_of_cells(rows)
    most = max(seeds.values(), default=0)
    for configuration in suite.configurations:
        cells = []
        for column in columns:
            found = [row for row in rows if row["configuration"] == configuration.name
                     and row["group"] == column]
            cells.append(result_cell(found, suite, decimals))
            say_fewer_seeds(cells[-1], seeds.get((configuration.name, column), 0), most)
        for index, column in enumerate(columns):
            if column == average:
                cells[index] = average_cell(
                    [cell for cell, name in zip(cells, columns) if name in groups], decimals)
        lines.append(Line(configuration.label, configuration.category, configuration.sensors,
                          True, cells))
    return lines


def compared_table(suite, rows, published):
    """Our rows below those of a paper, category by category."""
    lines = [Line(approach, category, sensors, False, [published_cell(text) for text in values])
             for approach, category, sensors, values in published.rows]
    lines += our_lines(suite, rows, published.columns, published.decimals, average="AVG")
    order = list(dict.fromkeys(line.category for line in lines))
    lines.sort(key=lambda line: order.index(line.category))
    mark(lines, suite.metric)
    notes = [f"Rows without * are from {published.source}.", *published.notes]
    notes += mark_notes(lines)
    table = Table(published.caption, list(published.columns), lines, notes)
    if "AVG" in table.columns:
        groups = {sequence.group for sequence in suite.sequences}
        notes += means_over_the_same(table, "AVG", groups, published.decimals)
    return table


def suite_table(suite, rows, marked=True):
    """All sequences of the suite with all configurations."""
    groups = list(dict.fromkeys(sequence.group for sequence in suite.sequences))
    degenerate = {sequence.group: sequence.degenerate for sequence in suite.sequences
                  if sequence.degenerate}
    lines = our_lines(suite, rows, groups, suite.decimals)
    if suite.average:
        for line in lines:
            line.cells.append(average_cell(line.cells, suite.decimals))
        groups.append("average")
    # With one configuration there is nothing to be better than.
    if marked and len(lines) > 1:
        mark(lines, suite.metric)
    notes = [f"{group}: degenerate by construction ({why})" for group, why in degenerate.items()]
    notes += seeds_note(suite, rows) + mark_notes(lines)
    table = Table(f"{suite.title}: {METRICS.get(suite.metric, suite.metric)}", groups, lines, notes,
                  transposed=suite.rows == "sequences")
    if suite.average:
        notes += means_over_the_same(table, "average", set(groups[:-1]), suite.decimals)
    table.columns = [f"{group} †" if group in degenerate else group for group in groups]
    return table


def speed_table(suite, rows):
    """What a second of data costs each run."""
    speed = dataclasses.replace(suite, metric="cpu_s_per_data_second", decimals=2)
    table = suite_table(speed, rows, marked=False)
    threads = names.counted(suite.threads, "thread")
    table.caption = f"{suite.title}: processor time for a second of data [s], {threads} a run"
    table.notes = ["Below 1, one core keeps up with the sensor. Reading the recording and writing "
                   "the results are counted.", *mark_notes(table.lines)]
    return table
