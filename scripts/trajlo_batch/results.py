# SPDX-License-Identifier: MIT
"""What came out of a batch: a row a run, with the options that vary, metrics, time and how it
ended."""
import dataclasses
import pathlib
import re
import shlex

import yaml

from trajlo_batch.places import read_json_if
from trajlo_batch.steps import simulate_command
from trajlo_batch.yaml_lines import SuiteError
from trajlo_batch.yaml_tree import flatten
from trajlo_report.names import did_you_mean, nearest

PARTIAL = 3  # exit code of runs whose input was damaged, left out in part or in doubt
USABLE = (0, PARTIAL)  # exit codes of runs whose whole recording was processed
OK, FAILED, UNFINISHED, NO_TRUTH = "ok", "x", "not finished", "no truth"
DETERMINED = "ate_rotation_determined"
FILLED_IN = ("sensor.T_body_lidar", "input.topics")  # options that the job of a run may say
NOT_ASKED = "not asked for"  # was not done, and the batch was told to do others only


def own_options(folder, asked):
    """The options that a run was made with, of those that are asked for now."""
    file = folder / "result" / "config.yaml"
    own = dict(flatten(yaml.safe_load(file.read_text()) or {})) if file.is_file() else {}
    # What the job fills in is not among those that are asked for.
    return {key: value if key in FILLED_IN else own.get(key) for key, value in asked.items()}


def varied_options(plan):
    """Options in which runs differ, or that have changed since; and for each run its values."""
    parsed, of_run = {}, {}
    for run in plan.runs:
        if run.options not in parsed:
            parsed[run.options] = dict(flatten(yaml.safe_load(run.options)))
        asked = parsed[run.options]
        of_run[run.folder] = (own_options(plan.places.output / run.folder, asked)
                              if run.outdated else asked)
    known = [*parsed.values(), *of_run.values()]
    keys = sorted(key for key in {key for options in known for key in options}
                  if len({str(options.get(key)) for options in known}) > 1)
    return keys, {folder: [options.get(key) for key in keys] for folder, options in of_run.items()}


def dig(tree, *keys):
    """The value below these keys; nothing if one of them is not there."""
    for key in keys:
        if not isinstance(tree, dict) or tree.get(key) is None:
            return None
        tree = tree[key]
    return tree


def evaluation_values(folder):
    """Metrics of an evaluated run, and why it counts as diverged, if it does."""
    document = read_json_if(folder / "evaluation" / "evaluation.json")
    estimate = dig({"list": document}, "list", "estimates") or [{}]
    estimate = estimate[0]
    values = {}
    # On a short or straight path the alignment leaves a turn open, which is no error of the run.
    determined = dig(estimate, "ate", "rotation_determined")
    for name, key in (("ate", "translation_m"), ("ate_rotation", "rotation_deg")):
        unit = "m" if key == "translation_m" else "deg"
        for statistic in ("rmse", "mean", "median", "std", "max"):
            known = key == "translation_m" or determined is not False
            values[f"{name}_{statistic}_{unit}"] = (dig(estimate, "ate", key, statistic) if known
                                                    else None)
    values[DETERMINED] = determined
    for piece in estimate.get("rpe") or []:
        over = f"rpe_{piece['delta']:g}{piece['unit']}"
        values[f"{over}_rmse_m"] = dig(piece, "translation_m", "rmse")
        values[f"{over}_rotation_rmse_deg"] = dig(piece, "rotation_deg", "rmse")
    values["kitti_translation_percent"] = dig(estimate, "kitti", "translation_percent")
    values["kitti_rotation_deg_per_m"] = dig(estimate, "kitti", "rotation_deg_per_m")
    for key in ("completeness", "pairs", "path_length_m", "duration_s", "time_offset_s"):
        values[key] = estimate.get(key)
    return values, divergence(estimate)


# Warnings of trajlo_evaluate that rows have in other columns: ate_rotation_determined, exit_code.
TOLD_OTHERWISE = re.compile("ATE \\[deg\\] says little|trajlo_run reported"
                            "|all rotations are exactly the identity")


def evaluation_warnings(folder):
    """What trajlo_evaluate doubts about the comparison of a run with the truth, in words."""
    document = read_json_if(folder / "evaluation" / "evaluation.json") or {}
    texts = [re.sub("^.*?: ", lambda begin: begin[0].rpartition("/")[2], text)  # the file's name
             for text in document.get("warnings") or []]
    return "; ".join(text for text in texts if not TOLD_OTHERWISE.search(text))


def divergence(estimate):
    """Why an evaluated run gets an x; nothing if it gets none."""
    if not estimate.get("diverged"):
        return ""
    reason = estimate.get("divergence_reason") or "diverged"
    # Evaluations of before have no field for it.
    short = estimate.get("incomplete", re.search(r"covers .* of the ground truth, less", reason))
    if not short:
        return reason
    return f"{reason}; if that is meant to be, say evaluate: {{min_completeness: 0}} in the sequence"


def run_values(folder):
    summary = read_json_if(folder / "result" / "run.json")
    if dig(summary, "exit", "reason") == "running":  # It was killed: its sums are still zeros.
        summary = {"versions": dig(summary, "versions")}
    return {
        "data_s": dig(summary, "result", "duration_s"),
        "times_real_time": dig(summary, "resources", "real_time_factor"),
        "estimation_ms_per_data_second":
            dig(summary, "resources", "estimation_ms_per_data_second", "median"),
        "inlier_share": dig(summary, "windows", "inlier_share"),
        "poses_flagged": dig(summary, "result", "poses_flagged"),
        "distance_to_start_m": dig(summary, "result", "distance_to_start_m"),
        "lost_at_s": dig(summary, "result", "lost_at_s"),
        "version": dig(summary, "versions", "git"),
    }


def metric_names():
    """Columns with numbers that a table can show; those of relative errors are as many as lengths
    that are asked for."""
    nowhere = pathlib.Path("/nowhere")
    names = [*evaluation_values(nowhere)[0], *run_values(nowhere), "cpu_s_per_data_second",
             "wall_s", "cpu_s", "peak_memory_mb"]
    return [name for name in names if name not in ("version", DETERMINED)]


def check_metric(suite, more=()):
    """Throws SuiteError for a metric that no run has; `more` are columns of this table alone."""
    names = [*metric_names(), *more]
    if suite.metric in names or re.fullmatch(r"rpe_[0-9.e+-]+[a-z]+_(rotation_rmse_deg|rmse_m)",
                                             suite.metric):
        return
    names += ["rpe_1m_rmse_m"]
    near = [*(name for name in names if name.startswith(suite.metric)),
            *nearest(suite.metric, names)]
    raise SuiteError(f"{suite.file}: metric: no run has '{suite.metric}'"
                     + (did_you_mean(near[0], "'") if near else f"; there are {', '.join(names)}"))


def outcome(folder, status, diverged):
    """One of OK, FAILED, UNFINISHED, NO_TRUTH, and the reason."""
    evaluation_status = read_json_if(folder / "evaluation_status.json")
    if not status:
        return UNFINISHED, ("see log.txt and snakemake.log" if (folder / "log.txt").is_file() else
                            "not started; see snakemake.log" if (folder / "job.json").is_file() else
                            "not started")
    if status["exit_code"] not in USABLE:
        return FAILED, status["reason"]
    if not evaluation_status:
        return UNFINISHED, "not evaluated; see snakemake.log"
    if evaluation_status["reason"] == "no truth":
        return NO_TRUTH, evaluation_status["reason"]
    if evaluation_status["reason"]:
        return FAILED, evaluation_status["reason"]
    return (FAILED, diverged) if diverged else (OK, status["reason"])


def in_doubt(row):
    """A run that ended well, but whose input was damaged, left out in part or in doubt."""
    return row["result"] in (OK, NO_TRUTH) and row.get("exit_code") == PARTIAL


@dataclasses.dataclass(frozen=True)
class Ended:
    """How a run ended, as the tables will say it."""
    result: str
    reason: str
    wall_s: float


def ended(folder):
    """Nothing until the run in this folder has been judged."""
    status = read_json_if(folder / "status.json")
    if not status:
        return None
    result, reason = outcome(folder, status, evaluation_values(folder)[1])
    return None if result == UNFINISHED else Ended(result, reason, status["wall_s"])


def cpu_per_data_second(cpu_s, data_s):
    """Seconds of processor time for a second of data. Unlike the time on the clock, it does not
    depend on what else the machine does."""
    return cpu_s / data_s if cpu_s and data_s else None


def collect(plan, asked=None):
    """The rows of all planned runs; all rows have the same keys in the same order. `asked` holds
    the folders of those that were to be done, if not all were."""
    keys, varied = varied_options(plan)
    rows = []
    for run in plan.runs:
        folder = plan.places.output / run.folder
        status = read_json_if(folder / "status.json") or {}
        metrics, diverged = evaluation_values(folder)
        result, reason = outcome(folder, status, diverged)
        if result == UNFINISHED and asked is not None and run.folder not in asked:
            result, reason = NOT_ASKED, "--only left it out"
        values = run_values(folder)
        rows.append({
            "suite": plan.suite.name, "configuration": run.configuration.name,
            "sequence": run.sequence.name, "group": run.sequence.group,
            "seed": run.sequence.seed or None, "degenerate": run.sequence.degenerate,
            **{key: value for key, value in zip(keys, varied[run.folder])},
            "result": result, "reason": reason, "outdated": ", ".join(run.outdated),
            "exit_code": status.get("exit_code"),
            "diverged": bool(diverged) if metrics["pairs"] is not None else None,
            "evaluation_warnings": evaluation_warnings(folder),
            **metrics, **values,
            "cpu_s_per_data_second": cpu_per_data_second(status.get("cpu_s"), values["data_s"]),
            **{key: status.get(key) for key in ("wall_s", "cpu_s", "peak_memory_mb", "started",
                                                "host")},
            "folder": run.folder, "command": rerun_command(plan, run, status),
        })
    names = list(dict.fromkeys(key for row in rows for key in row))
    return [{name: row.get(name) for name in names} for row in rows]


def with_output(command, folder):
    return [f"--output={folder}" if part.startswith("--output=") else part for part in command]


def rerun_command(plan, run, status, again=""):
    """What repeats the run in a folder of its own, for the shell; a recording that was deleted is
    simulated first."""
    command = with_output(status.get("command", []), again or f"{run.sequence.name}-again")
    recording = plan.places.output / "recordings" / run.sequence.name
    if not command or not run.sequence.scenario or recording.exists():
        return shlex.join(command)
    job = {"recording": run.job["recording"], "program": plan.programs["trajlo_simulate"]}
    return f"{shlex.join(simulate_command(job, recording))} && {shlex.join(command)}"
