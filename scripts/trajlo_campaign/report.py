# SPDX-License-Identifier: MIT
"""The table, results.csv and the page of a campaign."""
import collections
import csv
import io

from trajlo_campaign import judge
from trajlo_report import page
from trajlo_report.files import write_atomically


def cell(value):
    return f"{value:.6g}" if isinstance(value, float) else "" if value is None else str(value)


def to_csv(rows):
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    if rows:
        writer.writerow(rows[0])
    writer.writerows([cell(value) for value in row.values()] for row in rows)
    return stream.getvalue()


def percent(count, total):
    return f"{100.0 * count / total:.1f} %" if total else "–"


def shares(rows):
    """(verdict, count, share, what it means), in the order of VERDICTS."""
    counts = collections.Counter(row["verdict"] for row in rows)
    return [(name, counts[name], percent(counts[name], len(rows)), meaning)
            for name, meaning in judge.VERDICTS.items()]


def counted_by(rows, key):
    """For each value of `key` (or each fault) the counts of all verdicts."""
    table = collections.defaultdict(collections.Counter)
    for row in rows:
        for value in row[key].split(" + "):
            table[value][row["verdict"]] += 1
    return sorted(table.items())


def needless(rows):
    """Runs that gave up, or left a part out, though all their poses are right."""
    return [row for row in rows if row["verdict"] == judge.LOST and row["poses_wrong"] == 0]


def summary(rows):
    """The shares as text, a line each."""
    lines = [f"{len(rows)} runs"]
    lines += [f"  {name:20}{count:6}{share:>9}   {meaning}"
              for name, count, share, meaning in shares(rows)]
    right = sum(row["verdict"] == judge.PARTIAL and row["poses_wrong"] == 0 for row in rows)
    lines.append(f"{right} of the partial runs and {len(needless(rows))} of the lost ones have no "
                 "wrong pose")
    return "\n".join(lines)


def write(output, rows, seed, version):
    rows = sorted(rows, key=lambda row: row["run"])
    write_atomically(output / "results.csv", to_csv(rows))
    write_atomically(output / "summary.txt", summary(rows) + "\n")
    write_atomically(output / "report.html", page.render(
        "campaign.html", title="Random combinations of faults", rows=rows, seed=seed,
        version=version, shares=shares(rows), verdicts=list(judge.VERDICTS),
        scenes=counted_by(rows, "scene"), formats=counted_by(rows, "format"),
        faults=counted_by(rows, "faults"), note=summary(rows).splitlines()[-1],
        bad=[row for row in rows if row["verdict"] in judge.BAD]))
