# SPDX-License-Identifier: MIT
"""The table, results.csv and the page of a campaign."""
import collections
import csv

from trajlo_campaign import judge
from trajlo_campaign.scenes import CampaignError
from trajlo_report import names, page
from trajlo_report.files import to_csv, write_atomically

NUMBERS = ("run", "seed", "limit_m", "error_m", "end_error_m", "poses", "poses_wrong",
           "poses_flagged", "covered", "first_wrong_s", "cpu_s", "memory_mb")


def number(text):
    if not text:
        return None
    return int(text) if text.lstrip("-").isdigit() else float(text)


def read_rows(output, seed, version):
    """The rows that earlier calls left, by number of the run. Throws CampaignError if they are of
    another campaign: those of this one would be mixed with them."""
    path = output / "results.csv"
    if not path.is_file():
        return {}
    with path.open(newline="") as file:
        rows = [{key: number(value) if key in NUMBERS else value for key, value in row.items()}
                for row in csv.DictReader(file)]
    for row in rows:
        for name, here in (("seed", seed), ("version", version)):
            there = row.get(name, "unknown")
            if there != here:
                raise CampaignError(f"{path} is of {name} {there}, and this campaign of {here}; "
                                    "name another --output")
    return {row["run"]: row for row in rows}


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
    lines = [names.counted(len(rows), "run")]
    lines += [f"  {name:20}{count:6}{share:>9}   {meaning}"
              for name, count, share, meaning in shares(rows)]
    right = sum(row["verdict"] == judge.PARTIAL and row["poses_wrong"] == 0 for row in rows)
    lines.append(f"{right} of the partial runs and {len(needless(rows))} of the lost ones have no "
                 "wrong pose")
    return "\n".join(lines)


def write(output, rows, seed, version):
    """`rows` by number of the run, with those of earlier calls."""
    rows = [{"run": number, "seed": seed, "version": version, **row}
            for number, row in sorted(rows.items())]
    write_atomically(output / "results.csv", to_csv(rows))
    write_atomically(output / "summary.txt", summary(rows) + "\n")
    write_atomically(output / "report.html", page.render(
        "campaign.html", title="Random combinations of faults", rows=rows, seed=seed,
        version=version, shares=shares(rows), verdicts=list(judge.VERDICTS),
        scenes=counted_by(rows, "scene"), formats=counted_by(rows, "format"),
        faults=counted_by(rows, "faults"), note=summary(rows).splitlines()[-1],
        bad=[row for row in rows if row["verdict"] in judge.BAD]))
