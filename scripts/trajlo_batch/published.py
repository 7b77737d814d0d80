# SPDX-License-Identifier: MIT
"""Numbers of a paper, from config/published: rows of approaches over columns of sequences."""
import dataclasses
import pathlib

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


def published_of(suite):
    """(name, table) of each file that a suite is compared with."""
    return [(pathlib.PurePath(word).stem, read_published(suite_files.find(suite.file, word)))
            for word in suite.published]


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
