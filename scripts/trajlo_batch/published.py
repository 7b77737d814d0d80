# SPDX-License-Identifier: MIT
"""Numbers of a paper, from config/published: rows of approaches over columns of sequences."""
import dataclasses

from trajlo_batch import suite_files
from trajlo_batch.yaml_lines import SuiteError, check, load, texts

KEYS = {"source": str, "caption": str, "metric": str, "unit": str, "decimals": int,
        "columns": list, "notes": list, "rows": list}
ROW_KEYS = {"approach": str, "category": str, "sensors": str, "values": list}


@dataclasses.dataclass(frozen=True)
class Published:
    source: str
    caption: str
    metric: str
    unit: str
    decimals: int
    columns: tuple
    notes: tuple
    rows: tuple  # of (approach, category, sensors, values), all texts as printed


def is_value(text):
    if text in ("x", "-"):
        return True
    try:
        return float(text) >= 0
    except ValueError:
        return False


# The batch's own tables.
OWN_TABLES = ("table", "speed")
# What a column of results.csv is in, by the end of its name; the longer ends first.
UNITS = {"_deg_per_m": ("°/m", "deg/m"), "_m": ("m",), "_deg": ("°", "deg"), "_percent": ("%",),
         "_s": ("s",)}


def published_of(suite):
    """(name, table) of each file that a suite is compared with. Throws SuiteError where numbers would
    stand side by side that say different things."""
    found = []
    for word in suite.published:
        path = suite_files.find(suite.file, word)
        table = read_published(path)
        if path.stem in OWN_TABLES:
            raise SuiteError(f"{path}: the batch writes a {path.stem}.md of its own; give this file "
                             "another name")
        if table.metric != suite.metric:
            raise SuiteError(f"{path}: its numbers are {table.metric}, and those of {suite.file} are "
                             f"{suite.metric}; give the suite the metric {table.metric}")
        units = next((units for end, units in UNITS.items() if suite.metric.endswith(end)), ())
        if units and table.unit not in units:
            raise SuiteError(f"{path}: its numbers are in {table.unit}, and ours of {suite.metric} "
                             f"are in {units[0]}; convert those of the file")
        found.append((path.stem, table))
    return found


def read_published(path):
    """Throws SuiteError if a row has not one value for each column."""
    document = load(path)
    check(document, KEYS, "a published table")
    absent = [key for key in KEYS if key not in document and key != "notes"]
    if absent:
        raise SuiteError(f"{path}: {', '.join(absent)} is missing")
    columns = tuple(texts(document, "columns"))
    rows = []
    for row in document["rows"]:
        check(row, ROW_KEYS, "a row")
        values = tuple(texts(row, "values"))
        bad = [value for value in values if not is_value(value)]
        if bad or len(values) != len(columns):
            raise SuiteError(f"{row.where('values')}: {len(columns)} values are needed, numbers as "
                             f"texts, x or -; here are {len(values)} {bad or ''}".rstrip())
        rows.append((row["approach"], row["category"], row.get("sensors", ""), values))
    return Published(document["source"].strip(), document["caption"], document["metric"],
                     document["unit"], document["decimals"], columns,
                     tuple(texts(document, "notes")), tuple(rows))
