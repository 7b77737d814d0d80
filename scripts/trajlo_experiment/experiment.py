# SPDX-License-Identifier: MIT
"""What an experiment file says. config/experiments/README.md explains the keys."""
import dataclasses
import pathlib

from trajlo_batch import suite
from trajlo_batch.yaml_lines import SuiteError, check, load
from trajlo_experiment import designs
from trajlo_experiment.factors import number_or_text, read_factor
from trajlo_report.names import suggestion

EXPERIMENT_KEYS = {"title": str, "question": str, "needs": str, "design": dict, "vary": dict,
                   "center": dict, "marks": dict, "reference": str, "defaults": dict,
                   "sequences": list, "metric": str, "heat_maps": list, "threads": int,
                   "timeout_s": (int, float)}
DESIGN_KEYS = {"kind": str, "samples": int, "seed": int}
CENTER = "center"
# Given to trajlo_run as flags of their own, or what a job fills in.
RESERVED = ("threads", "sensor.T_body_lidar", "input.topics")


@dataclasses.dataclass(frozen=True)
class Design:
    kind: str
    samples: int = 0
    seed: int = 1


@dataclasses.dataclass(frozen=True)
class Experiment:
    """The file; `points` makes points and runs of it."""
    name: str
    file: pathlib.Path
    title: str
    question: str
    needs: str
    design: Design
    factors: tuple
    center: dict          # name of a factor -> level, for one_at_a_time
    marks: dict           # name -> {factor or key: value}: settings to run and to show
    reference: str        # the mark, or CENTER, that errors are relative to; else the median
    base_sequences: tuple
    metric: str
    heat_maps: tuple      # of (factor across, factor upwards[, factor of the rows])
    threads: int
    timeout_s: float

    def factor(self, name):
        return next((factor for factor in self.factors if factor.name == name), None)


def read_design(document):
    entry = document.get("design")
    if not entry:
        raise SuiteError(f"{document.file}: an experiment needs a design, as in "
                         "design: {kind: grid}")
    check(entry, DESIGN_KEYS, "a design")
    kind = suite.one_of(entry, "kind", designs.KINDS)
    if (kind in designs.SAMPLED) != (entry.get("samples", 0) > 0):
        raise SuiteError(f"{entry.where('samples')}: samples, from 1 on, belong to the designs "
                         f"{', '.join(designs.SAMPLED)}, and to these only")
    samples = entry.get("samples", 0)
    if kind == designs.SOBOL and samples & (samples - 1):
        raise SuiteError(f"{entry.where('samples')}: a Sobol design is balanced for 2, 4, 8, ... "
                         f"samples only, not {samples}")
    if entry.get("seed", 1) < 0:
        raise SuiteError(f"{entry.where('seed')}: a seed is a whole number from 0 on")
    return Design(kind, entry.get("samples", 0), entry.get("seed", 1))


def keys_of(factor):
    return {key for options in factor.settings.values() for key in options} | set(factor.keys)


def read_factors(document, kind):
    vary = document.get("vary")
    if not vary:
        raise SuiteError(f"{document.file}: an experiment needs something to vary")
    factors, owner = [read_factor(vary, name) for name in vary], {}
    for factor in factors:
        if not factor.levels and kind not in designs.SAMPLED:
            raise SuiteError(f"{vary.where(factor.name)}: the range of {factor.name} needs steps for a "
                             "design that takes values in turn")
        for key in keys_of(factor):
            if key in RESERVED:
                raise SuiteError(f"{vary.where(factor.name)}: {key} cannot vary: it belongs to the "
                                 "experiment and its sequences")
            if key in owner:
                raise SuiteError(f"{vary.where(factor.name)}: {factor.name} and {owner[key]} both "
                                 f"set {key}")
            owner[key] = factor.name
    return tuple(factors)


def checked_level(mapping, factor, value):
    """A level that a person wrote for a factor: any number for a scale, else one that it has."""
    level = number_or_text(value)
    fits = isinstance(level, (int, float)) if factor.numeric else level in factor.levels
    # Other kernels than those that vary may well be marked, but a name must have its settings.
    if not fits and (factor.numeric or factor.settings):
        raise SuiteError(f"{mapping.where(factor.name)}: {value!r} is no value of {factor.name}; "
                         f"it has {', '.join(map(str, factor.levels)) or 'numbers'}")
    return level


def read_center(document, factors, kind):
    """What the centre of one_at_a_time sets: what is said, and the first of named sets."""
    said = document.get("center", {})
    if said and kind != designs.ONE_AT_A_TIME:
        raise SuiteError(f"{document.where('center')}: only {designs.ONE_AT_A_TIME} has a center")
    known = {factor.name: factor for factor in factors}
    check(said, {name: (str, int, float, bool) for name in known}, "center")
    center = {}
    for name, factor in known.items():
        if name in said:
            center[name] = checked_level(said, factor, said[name])
        elif factor.settings:
            center[name] = factor.levels[0]
        elif kind == designs.ONE_AT_A_TIME and factor.key is None:
            raise SuiteError(f"{document.file}: {name} drives several keys and needs a value in "
                             "center")
    return center if kind == designs.ONE_AT_A_TIME else {}


def read_marks(document, factors):
    """name -> {factor or key: value}; keys are taken as --set has them."""
    known, marks = {factor.name: factor for factor in factors}, {}
    for name, entry in document.get("marks", {}).items():
        if not isinstance(entry, dict):
            raise SuiteError(f"{document['marks'].where(name)}: the mark {name} must be a mapping "
                             "of factors or options; {} marks the defaults")
        marks[name] = {key: checked_level(entry, known[key], entry[key]) if key in known
                       else suite.scalar_text(entry, key) for key in entry}
    return marks


def read_heat_maps(document, factors):
    names, maps = [factor.name for factor in factors], []
    for entry in document.get("heat_maps", []):
        if not isinstance(entry, list) or len(entry) not in (2, 3) or not set(entry) <= set(names):
            raise SuiteError(f"{document.where('heat_maps')}: a heat map is [across, upwards] or "
                             f"[across, upwards, rows] of {', '.join(names)}, not {entry!r}")
        maps.append(tuple(entry))
    return tuple(maps)


def check_truths(sequences, document):
    without = [sequence.name for sequence in sequences
               if not sequence.scenario and not sequence.truth]
    if without:
        raise SuiteError(f"{document.file}: an experiment compares with the truth, and "
                         f"{', '.join(without)} has none; name a file in truth, or leave it out")


def read_experiment(path):
    """Reads and checks an experiment. Throws SuiteError."""
    path = pathlib.Path(path)
    document = load(path)
    check(document, EXPERIMENT_KEYS, "an experiment")
    defaults = document.get("defaults", {})
    check(defaults, suite.SHARED_KEYS, "defaults")
    sequences = [sequence for entry in suite.entries(document, "sequences")
                 for sequence in suite.read_sequences(entry, defaults)]
    check_truths(sequences, document)
    design = read_design(document)
    factors = read_factors(document, design.kind)
    marks = read_marks(document, factors)
    reference = document.get("reference", "")
    known = [*marks, *([CENTER] if design.kind == designs.ONE_AT_A_TIME else [])]
    if reference and reference not in known:
        raise SuiteError(f"{document.where('reference')}: the reference is one of "
                         f"{', '.join(known) or 'no marks'}, not {reference}{suggestion(reference, known)}")
    return Experiment(
        name=path.stem, file=path, title=document.get("title", path.stem),
        question=document.get("question", ""), needs=document.get("needs", ""),
        design=design, factors=factors, center=read_center(document, factors, design.kind),
        marks=marks,
        reference=reference or (CENTER if CENTER in known else ""),
        base_sequences=suite.unique(sequences, "the sequence", document),
        metric=document.get("metric", "ate_rmse_m"),
        heat_maps=read_heat_maps(document, factors), threads=document.get("threads", 1),
        timeout_s=float(document.get("timeout_s", 0)))
