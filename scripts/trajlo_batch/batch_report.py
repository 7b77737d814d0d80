# SPDX-License-Identifier: MIT
"""results.csv, the tables, and one self-contained page about a batch."""
from trajlo_batch import results, table_formats, tables
from trajlo_batch.published import published_of
from trajlo_report import names, page
from trajlo_report.files import to_csv, write_atomically

# What the page shows of a run's figures, in this order.
FIGURES = {"map": "map and path from above, from the front and from the side",
           "trajectory": "truth and estimate in three planes", "over_time": "over time",
           "error_on_path": "translation error along the path",
           "error_components": "error of the position by component",
           "kitti_lengths": "relative errors by length",
           "windows": "what the estimator says of itself, over time"}
WIDE, WIDE_FIGURES = 760, ("map", "windows")


def make_tables(suite, rows):
    """One for each published table that the suite is compared with, and the suite's own."""
    found = [(name, tables.compared_table(suite, rows, published))
             for name, published in published_of(suite)]
    return found + [("table", tables.suite_table(suite, rows)),
                    ("speed", tables.speed_table(suite, rows))]


def write_tables(output, found):
    for name, table in found:
        write_atomically(output / f"{name}.md", table_formats.to_markdown(table))
        write_atomically(output / f"{name}.tex", table_formats.to_latex(table))
        write_atomically(output / f"{name}.csv", table_formats.to_csv(table))


def figures_of(folder):
    paths = {folder / "page" / "figures" / f"{name}.png": text for name, text in FIGURES.items()}
    return [{"path": path, "caption": caption, "width": WIDE if path.stem in WIDE_FIGURES else 470}
            for path, caption in paths.items() if path.is_file()]


def run_entry(plan, row):
    """What the page says about one run."""
    folder = plan.places.output / row["folder"]
    shown = [(key, value) for key, value in row.items()
             if value not in (None, "") and key not in ("command", "folder", "suite")]
    thumbnail = folder / "page" / "figures" / "thumbnail.png"
    options = folder / "result" / "config.yaml"
    return {
        "row": row, "anchor": anchor(row["folder"]), "figures": figures_of(folder),
        "thumbnail": thumbnail if thumbnail.is_file() else None,
        "page": f"{row['folder']}/page/run.html"
                if (folder / "page" / "run.html").is_file() else None,
        "numbers": shown,
        "config": options.read_text() if options.is_file() else "",
    }


def anchor(folder):
    return "run-" + folder.replace("/", "-")


def summary(rows):
    counts, remarks = {}, {}
    for row in rows:
        counts[row["result"]] = counts.get(row["result"], 0) + 1
        found = remarks.setdefault(row["result"], {})
        for remark, applies in (("with warnings about the input", results.in_doubt(row)),
                                ("with warnings about the comparison with the truth",
                                 bool(row.get("evaluation_warnings"))),
                                ("outdated", bool(row.get("outdated")))):
            found[remark] = found.get(remark, 0) + applies
    words = {results.OK: "ended well", results.FAILED: "with an x",
             results.UNFINISHED: "not finished", results.NO_TRUTH: "without truth",
             results.NOT_ASKED: "not asked for"}
    texts = []
    for result, count in counts.items():
        said = ", ".join(f"{some} {remark}" for remark, some in remarks[result].items() if some)
        texts.append(f"{count} {words[result]}" + (f" (of which {said})" if said else ""))
    return ", ".join(texts)


def about_outdated(rows, without="--report and --only"):
    """What has changed since the runs, and what to do about it; nothing if nothing has."""
    old = [row for row in rows if row["outdated"]]
    if not old:
        return ""
    changed = sorted({name for row in old for name in row["outdated"].split(", ")})
    builds = (" --any-version accepts other builds." if {"program", "simulator"} & {*changed} else "")
    return (f"Outdated: {len(old)} of {names.counted(len(rows), 'run')}; changed since: "
            f"{', '.join(changed)}. Without {without} the same command repeats them.{builds}")


def write_report(plan, asked=None):
    """Writes results.csv, tables and report.html below the batch's folder; returns the rows.
    `asked` holds the folders of the runs that were to be done, if not all were."""
    output, suite = plan.places.output, plan.suite
    if not plan.runs:
        return []
    rows = results.collect(plan, asked)
    write_atomically(output / "results.csv", to_csv(rows))
    found = make_tables(suite, rows)
    write_tables(output, found)
    programs = [(name, f"{program['version']} ({program['digest']})")
                for name, program in plan.programs.items()]
    ended = [run_entry(plan, row) for row in rows
             if row["result"] not in (results.UNFINISHED, results.NOT_ASKED)]
    text = page.render(
        "batch.html", title=suite.title, suite=suite, summary=summary(rows),
        outdated=about_outdated(rows),
        tables=[table for _, table in found], count=len(rows), runs=ended, anchor=anchor,
        heading=table_formats.heading, shown=table_formats.shown, good=tables.GOOD,
        metric=tables.METRICS.get(suite.metric, suite.metric),
        missing=plan.missing, programs=programs)
    write_atomically(output / "report.html", text)
    return rows
