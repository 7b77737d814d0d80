# SPDX-License-Identifier: MIT
"""From a suite to runs: each has a folder, a job file, and digests of what it depends on.

A run is done when its status.json carries the digests of its job. What has changed is moved to
OUTPUT/replaced/ before anything new is written, so that no result is ever overwritten.
"""
import dataclasses
import pathlib
import shutil

import yaml

from trajlo_batch import checks, suite_files
from trajlo_batch.kitti_calib import camera_in_lidar
from trajlo_batch.places import (ROOT, data_identity, digest, file_digest, identify, read_json_if,
                                 write_json)
from trajlo_batch.steps import lists_of_lidars
from trajlo_batch.yaml_lines import SuiteError
from trajlo_batch.yaml_tree import flatten

DONE, MISSING, CHANGED = "done", "missing", "changed"


@dataclasses.dataclass
class Run:
    """One configuration on one sequence."""
    configuration: object
    sequence: object
    job: dict
    options: str       # the effective configuration, as trajlo_run shows it
    state: str = MISSING
    changes: tuple = ()
    outdated: tuple = ()  # what the result that is there was made with and is otherwise now

    @property
    def folder(self):
        return run_name(self.configuration, self.sequence)


@dataclasses.dataclass
class Plan:
    suite: object
    places: object
    programs: dict
    runs: list
    missing: dict      # sequence name -> the files that were looked for


def recording_identity(places, sequence):
    if sequence.scenario:
        return {"scenario": sequence.scenario, "seed": sequence.seed,
                "duration_s": sequence.duration_s, "parameters": sequence.parameters}
    paths = [places.find(path) for path in sequence.recording]
    return {"paths": [str(path) for path in paths], "data": [data_identity(path) for path in paths]}


def files_sought(places, sequence):
    """What a sequence needs and is not there: recording, truth, and files that come with them."""
    paths = [*sequence.recording, *([sequence.truth] if sequence.truth else [])]
    named = (*sequence.config, *sequence.settings.values(), *sequence.run.values(),
             *sequence.evaluate.values())
    paths += [path.replace("{data}/", "") for path in named if path.startswith("{data}/")]
    found = [places.find(path) for path in paths]
    return [str(path) for path in found if not path.exists()]


def evaluation_flags(places, suite, sequence):
    """Flags of trajlo_evaluate, and digests of the files that they name. `kitti_calib` names a
    calib.txt of KITTI, whose truth is the path of camera 0."""
    values = suite_files.located(places, suite, sequence.evaluate)
    digests = suite_files.digests(values)
    calibration = values.pop("kitti_calib", None)
    if calibration:
        pose = camera_in_lidar(calibration)
        values["T_body_truth"] = ",".join(f"{number:.12g}" for number in pose.flat)
    return values, digests


def asked_options(places, suite, configuration, sequence, cache):
    key = str((sequence.config, configuration.name, sequence.settings, sequence.run))
    if key not in cache:
        cache[key] = checks.effective_options(places, suite, configuration, sequence)
    return cache[key]


def make_run(suite, places, programs, configuration, sequence, cache):
    options, files, values = asked_options(places, suite, configuration, sequence, cache)
    if sequence.name not in cache:
        cache[sequence.name] = recording_identity(places, sequence)
    recording = cache[sequence.name]
    truth = places.find(sequence.truth) if sequence.truth else None
    run_flags = suite_files.located(places, suite, sequence.run)
    tree = yaml.safe_load(options)
    named = suite_files.digests({**dict(flatten(tree)), **run_flags})
    evaluation, evaluation_files = evaluation_flags(places, suite, sequence)
    job = {
        "configuration": configuration.name, "sequence": sequence.name,
        "program": programs["trajlo_run"], "recording": recording, "config": files, "set": values,
        "run": run_flags, "topics": sequence.topics, "lidars": configuration.lidars,
        "lidar_options": lists_of_lidars(tree),
        "threads": suite.threads, "timeout_s": suite.timeout_s,
        "keep_map": suite.keep_maps,
        "depends_on": {
            "options": digest([options, run_flags, *named]),
            "recording": digest([recording, sequence.topics, configuration.lidars]),
            "program": programs["trajlo_run"]["digest"]},
        "evaluation": {
            "program": programs["trajlo_evaluate"],
            "truth": str(truth) if truth else "",
            "truth_digest": file_digest(truth) if truth and truth.is_file() else "",
            "has_truth": bool(truth or sequence.scenario),
            "flags": evaluation, "files": evaluation_files},
    }
    if sequence.scenario:
        job["depends_on"]["simulator"] = programs["trajlo_simulate"]["digest"]
    return Run(configuration, sequence, job, options)


def differences(old, new, any_version):
    """What a finished run depended on and has changed since."""
    ignored = {"program", "simulator"} if any_version else set()
    return tuple(sorted(key for key in {*old, *new}
                        if key not in ignored and old.get(key) != new.get(key)))


def evaluation_changed(folder, evaluation, any_version):
    """Whether a run was evaluated in another way than is asked for now."""
    old = read_json_if(folder / "evaluation_job.json")
    if not old or not (folder / "evaluation_status.json").is_file():
        return False

    def compared(job):
        program = None if any_version else job["program"]["digest"]
        return jsonable({**job, "program": program})

    return compared(old) != compared(evaluation)


def has_failed(folder, status):
    """Whether a run, or its evaluation, ended without a result."""
    evaluation = read_json_if(folder / "evaluation_status.json") or {}
    return status["exit_code"] not in (0, 3) or evaluation.get("reason", "") not in ("", "no truth")


def check_output(places, suite):
    """Throws SuiteError where results of another suite or experiment are, or would be within a
    recording."""
    other = (read_json_if(places.output / "jobs.json") or {}).get("suite", "")
    if other and other != suite_path(suite) and pathlib.Path(other).is_file():
        raise SuiteError(f"{places.output} holds the runs of {other}, and not of "
                         f"{suite_path(suite)}; name another folder with --output, or give the "
                         "file another name")
    output = places.output.absolute()
    for sequence in suite.sequences:
        for path in map(places.find, sequence.recording):
            if path.is_dir() and path.absolute() in (output, *output.parents):
                raise SuiteError(f"{output} lies in the recording {path}, which would change with "
                                 "every run; name another folder with --output")


def suite_path(suite):
    return str(pathlib.Path(suite.file).absolute())


def run_name(configuration, sequence):
    """What --only matches, and the run's folder."""
    return f"{configuration.name}/{sequence.name}"


def run_names(suite):
    """Those of all runs, whether their data are there or not."""
    return [run_name(configuration, sequence) for configuration, sequence in suite.pairs]


def make_plan(suite, places, any_version=False, retry=False):
    """Looks at the suite and at what is there; writes nothing. Throws SuiteError."""
    names = ["trajlo_run", "trajlo_evaluate"]
    names += ["trajlo_simulate"] if any(item.scenario for item in suite.sequences) else []
    programs = {name: identify(places.program(name)) for name in names}
    check_output(places, suite)
    checks.check_pairs(places, suite)
    runs, missing, cache = [], {}, {}
    for configuration, sequence in suite.pairs:
        asked_options(places, suite, configuration, sequence, cache)  # also where data are missing
        sought = files_sought(places, sequence)
        if sought:
            missing[sequence.name] = sought
            continue
        run = make_run(suite, places, programs, configuration, sequence, cache)
        status = read_json_if(places.output / run.folder / "status.json")
        if status:
            run.changes = differences(status["depends_on"], run.job["depends_on"], any_version)
            run.outdated = run.changes
            if evaluation_changed(places.output / run.folder, run.job["evaluation"], any_version):
                run.outdated += ("evaluation",)
            if retry and has_failed(places.output / run.folder, status):
                run.changes += ("it failed",)
            run.state = CHANGED if run.changes else DONE
        runs.append(run)
    return Plan(suite, places, programs, runs, missing)


def set_aside(places, run):
    """Moves a result that is no longer asked for to OUTPUT/replaced/."""
    base = places.output / "replaced" / run.configuration.name
    base.mkdir(parents=True, exist_ok=True)
    count = 1
    while (base / f"{run.sequence.name}.{count}").exists():
        count += 1
    (places.output / run.folder).rename(base / f"{run.sequence.name}.{count}")


def write_if_changed(path, value):
    """Snakemake goes by times of files: what says the same must not become newer. Returns whether
    it says something else now."""
    changed = read_json_if(path) != value
    if changed:
        write_json(path, value)
    return changed


def remove_recording(output, name):
    """One of another simulator or of other parameters. Left in place, Snakemake would make it anew,
    but none of the runs, which take a recording of any age."""
    shutil.rmtree(output / "recordings" / name, ignore_errors=True)
    for suffix in (".tum", ".yaml"):
        (output / "truth" / f"{name}{suffix}").unlink(missing_ok=True)


def write_recording_jobs(plan):
    """A job file for each recording that has to be simulated."""
    names = []
    for sequence in plan.suite.sequences:
        runs = [run for run in plan.runs if run.sequence.name == sequence.name]
        if not sequence.scenario or not runs:
            continue
        names.append(sequence.name)
        path = plan.places.output / "recordings" / f"{sequence.name}.json"
        job = {"recording": runs[0].job["recording"], "program": plan.programs["trajlo_simulate"]}
        # With finished runs of another version that are kept, the recording is kept as well.
        is_asked = any(run.state != DONE for run in runs) or not path.is_file()
        if is_asked and write_if_changed(path, job):
            remove_recording(plan.places.output, sequence.name)
    return names


def write_plan(plan, keep_recordings):
    """Sets aside what has changed, and writes the job files and the table for Snakemake."""
    output = plan.places.output
    for run in plan.runs:
        if run.state == CHANGED:
            set_aside(plan.places, run)
            run.state = MISSING
        run.outdated = ()  # is done again
        folder = output / run.folder
        job = {key: value for key, value in run.job.items() if key != "evaluation"}
        if run.state != DONE:
            write_if_changed(folder / "job.json", jsonable(job))
        write_if_changed(folder / "evaluation_job.json", jsonable(run.job["evaluation"]))
    table = {
        "suite": suite_path(plan.suite),
        "runs": [{"folder": run.folder, "recording": run.sequence.name if run.sequence.scenario
                  else ""} for run in plan.runs],
        "recordings": write_recording_jobs(plan), "threads": plan.suite.threads,
        "goal": plan.suite.goal, "keep_recordings": keep_recordings,
        "scripts": str(ROOT / "scripts")}
    write_json(output / "jobs.json", table)


def jsonable(value):
    """As it will be read again: tuples become lists."""
    if isinstance(value, dict):
        return {key: jsonable(item) for key, item in value.items()}
    return [jsonable(item) for item in value] if isinstance(value, (list, tuple)) else value
