# SPDX-License-Identifier: MIT
"""Which poses of a run it does not trust itself."""
import csv
import decimal
import pathlib
import re

import numpy as np

# Rounds that ran out say nothing of whether a pose is right: healthy runs have such windows.
NO_DISTRUST = {"", "not_converged"}
# The companion of the trajectory comes first: it has a line for each pose.
FILES = (("flags.csv", "t_s"), ("windows.csv", "end_s"))


def distrusted(names):
    return any(name not in NO_DISTRUST for name in re.split("[|; ]", names))


def flagged_times_ns(result):
    """Stamps of the poses, or ends of the windows, that have a flag; in ns."""
    for name, column in FILES:
        path = pathlib.Path(result) / name
        if not path.is_file():
            continue
        times = []
        with path.open(newline="", errors="replace") as file:
            for row in csv.DictReader(line.replace("\0", "") for line in file):
                if row.get("flag_names") and distrusted(row["flag_names"]):
                    times.append(int(decimal.Decimal(row[column]).scaleb(9)))
        return np.array(sorted(times), dtype=np.int64)
    return np.zeros(0, dtype=np.int64)


def near_a_flag(times_ns, flagged_ns, within_ns):
    """For each pose whether one that has a flag is so near in time."""
    if not len(flagged_ns):
        return np.zeros(len(times_ns), dtype=bool)
    after = np.clip(np.searchsorted(flagged_ns, times_ns), 0, len(flagged_ns) - 1)
    before = np.maximum(after - 1, 0)
    return np.minimum(np.abs(flagged_ns[after] - times_ns),
                      np.abs(flagged_ns[before] - times_ns)) <= within_ns
