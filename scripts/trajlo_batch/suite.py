# SPDX-License-Identifier: MIT
"""What a suite file says. config/suites/README.md explains the keys."""
import dataclasses
import fnmatch
import pathlib
import re

from trajlo_batch.yaml_lines import SuiteError, check, load, texts
from trajlo_report.names import decimals_of, suggestion

NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9._+-]*")

# What sequences may say, and `defaults` for all of them.
SHARED_KEYS = {"recording": (str, list), "truth": str, "topics": list, "config": (str, list),
               "set": dict, "run": dict, "evaluate": dict, "seeds": list,
               "duration_s": (int, float), "parameters": dict}
# Only recordings that are simulated have these, and only those that are there the others.
SIMULATED_KEYS = ("seeds", "duration_s", "parameters")
RECORDED_KEYS = ("recording", "truth", "topics")
SEQUENCE_KEYS = {"name": str, "simulate": str, "degenerate": str, **SHARED_KEYS}
CONFIGURATION_KEYS = {"name": str, "label": str, "category": str, "sensors": str, "lidars": list,
                      "config": (str, list), "set": dict, "only": (str, list), "note": str}
SUITE_KEYS = {"title": str, "description": str, "needs": str, "defaults": dict, "sequences": list,
              "configurations": list, "metric": str, "decimals": int, "over_seeds": str,
              "rows": str, "average": bool, "published": (str, list), "threads": int,
              "timeout_s": (int, float)}


@dataclasses.dataclass(frozen=True)
class Sequence:
    """One recording with its truth: simulated, or files below the folder of data sets."""
    name: str          # of its folder
    group: str         # the same for all seeds of a scenario: a row of the tables
    scenario: str = ""
    seed: int = 0
    duration_s: float = 0.0
    parameters: dict = dataclasses.field(default_factory=dict)
    recording: tuple = ()
    truth: str = ""
    topics: tuple = ()
    config: tuple = ()
    settings: dict = dataclasses.field(default_factory=dict)
    run: dict = dataclasses.field(default_factory=dict)
    evaluate: dict = dataclasses.field(default_factory=dict)
    degenerate: str = ""


@dataclasses.dataclass(frozen=True)
class Configuration:
    """What is tried on all sequences, or on those that `only` matches."""
    name: str
    label: str
    category: str = "LO"
    sensors: str = ""
    lidars: tuple = ()
    config: tuple = ()
    settings: dict = dataclasses.field(default_factory=dict)
    only: tuple = ()
    note: str = ""

    def takes(self, sequence):
        names = (sequence.name, sequence.group)
        return not self.only or any(fnmatch.fnmatchcase(name, pattern)
                                    for pattern in self.only for name in names)


@dataclasses.dataclass(frozen=True)
class Suite:
    name: str
    file: pathlib.Path
    title: str
    description: str
    needs: str
    sequences: tuple
    configurations: tuple
    published: tuple
    metric: str = "ate_rmse_m"
    decimals: int = 4
    over_seeds: str = "median"
    rows: str = "sequences"
    average: bool = False
    threads: int = 1
    timeout_s: float = 0.0
    goal = "page/run.html"  # the last file of a run
    keep_maps = True

    @property
    def pairs(self):
        """What is run: all configurations on the sequences that they take."""
        return [(configuration, sequence) for configuration in self.configurations
                for sequence in self.sequences if configuration.takes(sequence)]

    def described(self, run):
        """What lists and the progress call a run."""
        return run.folder


def scalar_text(mapping, key):
    """A value as `--set` wants it."""
    value = mapping[key]
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, str) and "," not in value:
        return value
    raise SuiteError(f"{mapping.where(key)}: {key} must be a number, a text without commas, or "
                     f"true or false, not {value!r}; put it into a file and name that in config")


def settings(mapping, key):
    values = mapping.get(key, {})
    return {name: scalar_text(values, name) for name in values}


def flags(mapping, key):
    """More flags of a program; other than the values of --set, theirs may have commas."""
    values = mapping.get(key, {})
    return {name: values[name] if isinstance(values[name], str) else scalar_text(values, name)
            for name in values}


# Folders of the batch itself.
RESERVED = ("recordings", "truth", "replaced", "slurm")


def valid_name(mapping, name):
    if not NAME.fullmatch(name):
        raise SuiteError(f"{mapping.where('name')}: {name!r} cannot be the name of a folder; use "
                         "letters, digits and . _ + -")
    if name in RESERVED:
        raise SuiteError(f"{mapping.where('name')}: the batch has a folder {name} of its own; choose "
                         "another name")
    return name


def check_kind(entry):
    """A key that would be without effect is refused; `defaults` may have those of both kinds."""
    is_simulated = "simulate" in entry
    for key in RECORDED_KEYS if is_simulated else SIMULATED_KEYS:
        if key not in entry:
            continue
        kind = "is simulated" if is_simulated else "is not simulated"
        instead = (": set input.duration_s reads a part of a recording"
                   if key == "duration_s" else "")
        raise SuiteError(f"{entry.where(key)}: this sequence {kind}, and has no use for {key}"
                         f"{instead}")


def read_sequences(entry, defaults):
    """The sequences of one entry: one, or one per seed."""
    check(entry, SEQUENCE_KEYS, "a sequence")
    check_kind(entry)
    both = {**defaults, **entry}
    group = valid_name(entry, entry.get("name") or entry.get("simulate") or "")
    own = {key: texts(entry, key) for key in ("config", "recording", "topics")}
    common = {key: texts(defaults, key) for key in own} if defaults else {key: [] for key in own}
    shared = {
        "group": group,
        "config": tuple(common["config"] + own["config"]),
        "topics": tuple(topic.replace("{name}", group)
                        for topic in own["topics"] or common["topics"]),
        "settings": {**settings(defaults, "set"), **settings(entry, "set")},
        "run": {**flags(defaults, "run"), **flags(entry, "run")},
        "evaluate": {**flags(defaults, "evaluate"), **flags(entry, "evaluate")},
        "degenerate": entry.get("degenerate", ""),
    }
    shared["evaluate"] = {key: value.replace("{name}", group)
                          for key, value in shared["evaluate"].items()}
    if "simulate" in entry:
        for seed in both.get("seeds", [1]):
            if not isinstance(seed, int) or seed < 1:
                raise SuiteError(f"{entry.where('seeds')}: a seed is a whole number from 1 on, "
                                 f"not {seed!r}")
            yield Sequence(
                name=f"{group}-seed{seed}", scenario=entry["simulate"], seed=seed,
                duration_s=float(both.get("duration_s", 0)),
                parameters={**settings(defaults, "parameters"), **settings(entry, "parameters")},
                **shared)
        return
    recording = own["recording"] or common["recording"]
    if not recording:
        raise SuiteError(f"{entry.where()}: the sequence {group} names neither a scenario "
                         "(simulate) nor files (recording)")
    yield Sequence(name=group, truth=both.get("truth", "").replace("{name}", group),
                   recording=tuple(path.replace("{name}", group) for path in recording), **shared)


def read_configuration(entry):
    check(entry, CONFIGURATION_KEYS, "a configuration")
    if "name" not in entry:
        raise SuiteError(f"{entry.where()}: a configuration needs a name")
    lidars = entry.get("lidars", [])
    if not all(isinstance(lidar, int) and lidar >= 0 for lidar in lidars):
        raise SuiteError(f"{entry.where('lidars')}: lidars counts from 0, not {lidars!r}")
    name = valid_name(entry, entry["name"])
    return Configuration(name=name, label=entry.get("label", name),
                         category=entry.get("category", "LO"), sensors=entry.get("sensors", ""),
                         lidars=tuple(lidars), config=tuple(texts(entry, "config")),
                         settings=settings(entry, "set"), only=tuple(texts(entry, "only")),
                         note=entry.get("note", ""))


def unique(items, what, document):
    names = [item.name for item in items]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise SuiteError(f"{document.file}: {what} {', '.join(twice)} appears twice")
    return tuple(items)


def one_of(document, key, choices):
    value = document.get(key, choices[0])
    if value not in choices:
        raise SuiteError(f"{document.where(key)}: {key} is one of {', '.join(choices)}, "
                         f"not {value!r}"
                         + suggestion(str(value), choices, "'"))
    return value


def entries(document, key):
    found = document.get(key) or []
    if not found:
        raise SuiteError(f"{document.file}: a suite needs {key}")
    for entry in found:
        if not isinstance(entry, dict):
            raise SuiteError(f"{document.where(key)}: {entry!r} in {key} is no mapping")
    return found


def read_suite(path):
    """Reads and checks a suite. Throws SuiteError."""
    path = pathlib.Path(path)
    document = load(path)
    check(document, SUITE_KEYS, "a suite")
    defaults = document.get("defaults", {})
    check(defaults, SHARED_KEYS, "defaults")
    sequences = [sequence for entry in entries(document, "sequences")
                 for sequence in read_sequences(entry, defaults)]
    configurations = [read_configuration(entry) for entry in entries(document, "configurations")]
    metric = document.get("metric", "ate_rmse_m")
    suite = Suite(
        name=path.stem, file=path, title=document.get("title", path.stem),
        description=document.get("description", ""), needs=document.get("needs", ""),
        sequences=unique(sequences, "the sequence", document),
        configurations=unique(configurations, "the configuration", document),
        published=tuple(texts(document, "published")),
        metric=metric, decimals=document.get("decimals", decimals_of(metric)),
        over_seeds=one_of(document, "over_seeds", ("median", "mean", "max")),
        rows=one_of(document, "rows", ("sequences", "configurations")),
        average=document.get("average", False), threads=document.get("threads", 1),
        timeout_s=float(document.get("timeout_s", 0)))
    for configuration in suite.configurations:
        if not any(configuration.takes(sequence) for sequence in suite.sequences):
            raise SuiteError(f"{path}: the configuration {configuration.name} is only for "
                             f"{', '.join(configuration.only)}, which matches no sequence")
    return suite
