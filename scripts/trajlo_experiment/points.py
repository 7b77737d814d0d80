# SPDX-License-Identifier: MIT
"""From an experiment to its points, and to pairs of point and recording for trajlo_batch.

A point's folder is named by what it sets: values that are added to an experiment leave the runs
of the others as they are.
"""
import dataclasses

import yaml

from trajlo_batch import checks
from trajlo_batch.places import digest, read_json_if, write_json
from trajlo_batch.yaml_tree import flatten
from trajlo_batch.suite import Configuration
from trajlo_batch.yaml_lines import SuiteError
from trajlo_experiment import designs
from trajlo_experiment.experiment import CENTER
from trajlo_experiment.factors import SIMULATE, level_of, number_or_text, text_of


@dataclasses.dataclass
class Point:
    """One setting, tried on all recordings."""
    levels: dict             # name of a factor -> level; what is not in it is left to the defaults
    options: dict            # key -> text
    parameters: dict         # of simulated scenarios
    in_design: bool = True   # false: only there because it is marked
    marks: tuple = ()

    @property
    def name(self):
        return f"point-{digest([self.options, self.parameters])[:8]}"

    @property
    def settings(self):
        """All that it sets, as an experiment writes it: {option or parameter: text}."""
        return {**self.options,
                **{f"{SIMULATE}{key}": text for key, text in self.parameters.items()}}


@dataclasses.dataclass(frozen=True)
class Study:
    """An experiment with its points; to trajlo_batch it is a suite."""
    experiment: object
    points: tuple
    shown: dict              # name of a factor -> level where a point does not set it
    sequences: tuple
    pairs: tuple
    goal = "evaluation_status.json"
    keep_maps = False        # nine tenths of a result, and nobody looks at hundreds of maps

    def described(self, run):
        """The name of a point is a digest, which says nothing; its label does."""
        return f"{run.folder} ({run.configuration.label})"

    def __getattr__(self, name):  # name, file, needs, threads, timeout_s
        return getattr(self.experiment, name)


def make_point(experiment, levels, extra=None):
    """A point from levels, and from options that are no factors: these are what somebody wrote about
    this very point, and stand above those that a level brings along."""
    settings = {}
    for name, level in levels.items():
        settings.update(experiment.factor(name).options(level))
    settings.update(extra or {})
    options = {key: text for key, text in settings.items() if not key.startswith(SIMULATE)}
    parameters = {key.removeprefix(SIMULATE): text for key, text in settings.items()
                  if key.startswith(SIMULATE)}
    return Point(levels, options, parameters)


def words_of(experiment, point):
    """The values of a point, and the names of those that have one."""
    return ", ".join([*(level_of(experiment.factor(name), level)
                        for name, level in point.levels.items()),
                      *(f'"{mark}"' for mark in point.marks)])


def design_file(output):
    return output / "design.json"


def specification(experiment):
    return {"design": dataclasses.asdict(experiment.design),
            "factors": [dataclasses.asdict(factor) for factor in experiment.factors]}


def sampled_levels(experiment, output):
    """The points of a sampled design: those that were saved, as another version of SciPy may draw
    others."""
    saved = read_json_if(design_file(output)) or {}
    key = digest(specification(experiment))
    if saved.get("specification_digest") == key:
        return saved["levels"]
    design = experiment.design
    return designs.sampled(design.kind, experiment.factors, design.samples, design.seed)


def design_levels(experiment, shown, output):
    kind = experiment.design.kind
    if kind == designs.GRID:
        return designs.grid(experiment.factors)
    if kind == designs.ONE_AT_A_TIME:
        return designs.one_at_a_time(experiment.factors, experiment.center, shown)
    return sampled_levels(experiment, output)


def marked_point(experiment, mark, values):
    levels = {**experiment.center,
              **{key: value for key, value in values.items() if experiment.factor(key)}}
    extra = {key: value for key, value in values.items() if not experiment.factor(key)}
    point = make_point(experiment, levels, extra)
    point.in_design, point.marks = False, (mark,)
    return point


def beyond(point, defaults):
    """What a point sets to something else than the recordings have by themselves."""
    return {key: text for key, text in point.settings.items()
            if key not in defaults or number_or_text(text) != number_or_text(text_of(defaults[key]))}


def does_the_same(places, experiment, one, other):
    """Whether two points that seem to set the same have the same options on all recordings."""
    for sequence in {str((base.config, base.settings)): base
                     for base in experiment.base_sequences}.values():
        texts = [checks.effective_options(
            places, experiment, Configuration(point.name, "", settings=point.options), sequence)[0]
            for point in (one, other)]
        if yaml.safe_load(texts[0]) != yaml.safe_load(texts[1]):
            return False
    return True


def add_marked(points, point, defaults, places, experiment):
    """Adds a mark, or gives its name to the point that does the same in other words: the defaults
    are on many a grid."""
    twin = points.get(point.name) or next(
        (known for known in points.values() if beyond(known, defaults) == beyond(point, defaults)
         and does_the_same(places, experiment, known, point)), None)
    if twin:
        twin.marks += point.marks
    else:
        points[point.name] = point


def make_points(experiment, defaults, places):
    points, shown = {}, shown_values(experiment, defaults)
    for index, levels in enumerate(design_levels(experiment, shown, places.output)):
        point = make_point(experiment, levels)
        if experiment.design.kind == designs.ONE_AT_A_TIME and index == 0:
            point.marks = (CENTER,)
        points.setdefault(point.name, point)
    for mark, values in experiment.marks.items():
        add_marked(points, marked_point(experiment, mark, values), defaults, places, experiment)
    return tuple(points.values())


def shown_values(experiment, defaults):
    """What factors are when no point sets them."""
    return {factor.name: defaults[factor.key] for factor in experiment.factors
            if factor.key in defaults}


def default_values(experiment, places):
    """What options and parameters are when no point sets them, as far as that is the same on all
    sequences: {key: value}."""
    found = []
    seen = {}
    for sequence in experiment.base_sequences:
        key = (sequence.config, tuple(sequence.settings.items()))
        if key not in seen:
            nothing = Configuration("its own options", "")
            text, _, _ = checks.effective_options(places, experiment, nothing, sequence)
            seen[key] = dict(flatten(yaml.safe_load(text)))
        values = dict(seen[key])
        if sequence.scenario and any(factor.name.startswith(SIMULATE)
                                     for factor in experiment.factors):
            listed = checks.scenario_parameters(places, experiment, sequence)
            values.update({f"{SIMULATE}{key}": number_or_text(value)
                           for key, value in listed.items()})
        found.append(values)
    return {key: value for key, value in found[0].items()
            if all(key in values and values[key] == value for values in found)}


def with_parameters(experiment, sequence, parameters):
    """A sequence whose scenario has other parameters: another recording."""
    if not parameters:
        return sequence
    if not sequence.scenario:
        raise SuiteError(f"{experiment.file}: {sequence.name} is a recording: its "
                         f"{', '.join(parameters)} cannot vary")
    return dataclasses.replace(
        sequence, name=f"{sequence.name}-{digest(parameters)[:6]}",
        parameters={**sequence.parameters, **parameters})


def make_study(experiment, places):
    """Points and runs. Throws SuiteError where an option or a parameter is refused."""
    defaults = default_values(experiment, places)
    points = make_points(experiment, defaults, places)
    sequences, pairs = {}, []
    for point in points:
        configuration = Configuration(point.name, words_of(experiment, point),
                                      settings=point.options)
        for base in experiment.base_sequences:
            sequence = with_parameters(experiment, base, point.parameters)
            sequences.setdefault(sequence.name, sequence)
            pairs.append((configuration, sequence))
    return Study(experiment, points, shown_values(experiment, defaults), tuple(sequences.values()),
                 tuple(pairs))


def save_design(study, output):
    """design.json: what was tried, for readers and for the next batch of the same design."""
    write_json(design_file(output), {
        "specification": specification(study.experiment),
        "specification_digest": digest(specification(study.experiment)),
        "levels": [point.levels for point in study.points if point.in_design],
        "points": {point.name: {"levels": point.levels, "marks": list(point.marks),
                                "options": point.options, "parameters": point.parameters}
                   for point in study.points}})
