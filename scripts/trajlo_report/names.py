# SPDX-License-Identifier: MIT
"""Names for people: `hall_os1_16` is "Hall, OS1-16"."""
import difflib
import re

# How makers write their sensors: a pattern over the words of a name, and its text.
SENSORS = (
    (r"os(\d) (\d+)x(\d)", r"\3 × OS\1-\2"), (r"os(\d) (\d+)", r"OS\1-\2"),
    (r"vlp(\d+)", r"VLP-\1"), (r"hdl(\d+)", r"HDL-\1"), (r"xt(\d+)", r"PandarXT-\1"),
    (r"mid(\d+)", r"Livox MID-\1"), (r"avia", "Livox Avia"), (r"hilti", "OS0-64 and Livox MID-70"),
    (r"kitti", "KITTI's format"))
MARK = " †"  # of a scenario that is degenerate by construction


def decimals_of(metric):
    """After the decimal point of a value in a table: errors in metres are told apart by a tenth of a
    millimetre, which many runs differ by."""
    return 5 if metric.endswith("_per_m") else 4 if metric.endswith("_m") else 3


def counted(count, one, many=""):
    """ "1 run", "2 runs" """
    return f"{count} {one if count == 1 else many or one + 's'}"


def nearest(word, known):
    """The known word that a misspelt one was meant to be, as a list; empty where none is near."""
    return difflib.get_close_matches(word, list(known), 1)


def did_you_mean(right, quote=""):
    """ "; did you mean right?", or nothing where `right` is empty. The quote is that of the wrong word
    in the message, if it has one."""
    return f"; did you mean {quote}{right}{quote}?" if right else ""


def suggestion(word, known, quote=""):
    """The same with the known word that is nearest."""
    return did_you_mean("".join(nearest(word, known)), quote)


def scenario_title(name):
    """A scenario's name, the sensor after a comma; other names are left as they are."""
    words = name.replace("_", " ")
    for pattern, text in SENSORS:
        match = re.fullmatch(rf"(.+) {pattern}", words)
        if match:
            place = match.group(1)
            sensor = re.sub(rf"^.+ {pattern}$", text, words)
            return f"{place[0].upper()}{place[1:]}, {sensor}"
    return name


def title(name):
    """A sequence: a scenario, perhaps with the seed that "-seed2" says, perhaps with a mark."""
    plain = name.removesuffix(MARK)
    scenario, _, seed = plain.partition("-seed")
    known = scenario_title(scenario)
    if known == scenario:
        return name
    return (f"{known}, seed {seed}" if seed else known) + name[len(plain):]
