# SPDX-License-Identifier: MIT
"""results.csv of an experiment: a row a run, what varied, every metric, how to repeat it."""
import csv
import shlex

import numpy as np

from trajlo_batch import results, tables
from trajlo_batch.places import read_json_if
from trajlo_batch.yaml_lines import SuiteError
from trajlo_report import files

FLAGS = ("no_points", "gap", "reverted", "not_converged", "degenerate", "lost",
         "few_inliers", "jump", "lone_object")
COLUMNS = {"points": "points_per_window", "rounds": "rounds_per_window",
           "iterations": "iterations_per_window"}
METRICS = ("cpu_ms_per_data_second", "windows", *COLUMNS.values(), "rejected_steps",
           "smallest_eigenvalue_median", "smallest_eigenvalue_min", "share_flagged",
           *(f"share_{flag}" for flag in FLAGS))  # besides those of a batch
LEFT_OUT = ("suite", "configuration", "degenerate", "sequence", "group", "seed", "inlier_share",
            "cpu_s_per_data_second", "data_s", "version", "folder", "command")


def check_metric(experiment):
    """Throws SuiteError for a metric that no run has, or whose least value is not the best."""
    results.check_metric(experiment, METRICS)
    if not tables.SMALLER_IS_BETTER.fullmatch(experiment.metric):
        raise SuiteError(f"{experiment.file}: metric: settings are ranked from the least value up, "
                         f"and the least {experiment.metric} is not the best")


def window_columns(path, names):
    """Columns of windows.csv as texts; a line that was cut off is left out."""
    with path.open(newline="") as file:
        reader = csv.reader(file)
        head = next(reader, [])
        places = [head.index(name) for name in names]
        rows = [[row[place] for place in places] for row in reader if len(row) == len(head)]
    return dict(zip(names, zip(*rows))) if rows else {}


def window_values(folder):
    """Statistics of all windows of a run, also of one that crashed."""
    names = [*COLUMNS, "inlier_share", "rejected_steps", "smallest_eigenvalue"]
    path = folder / "result" / "windows.csv"
    columns = window_columns(path, names) if path.is_file() else {}
    if not columns:
        return {}
    values = {"windows": len(columns["points"])}
    for name, title in COLUMNS.items():
        values[title] = float(np.mean(np.array(columns[name], dtype=float)))
    values["rejected_steps"] = int(np.sum(np.array(columns["rejected_steps"], dtype=float)))
    eigenvalues = np.array(columns["smallest_eigenvalue"], dtype=float)
    values["smallest_eigenvalue_median"] = float(np.median(eigenvalues))
    values["smallest_eigenvalue_min"] = float(eigenvalues.min())
    values["inlier_share"] = float(np.mean(np.array(columns["inlier_share"], dtype=float)))
    return values


def flag_values(folder):
    """The share of poses with any flag, and with each."""
    flagged = [text.split("|") for text in files.read_flags(folder / "result")[1]]
    if not flagged:
        return {}
    values = {"share_flagged": float(np.mean([names != [""] for names in flagged]))}
    for flag in FLAGS:
        values[f"share_{flag}"] = float(np.mean([flag in names for names in flagged]))
    return values


def level_values(study, point, row):
    """The level of each factor; where a point does not set it, what the run had by itself."""
    values = {}
    for factor in study.factors:
        level = point.levels.get(factor.name)
        if level is None:
            level = row.get(factor.key) if factor.key in row else study.shown.get(factor.name)
        values[factor.name] = level
    return values


def milliseconds(seconds):
    return None if seconds is None else 1000.0 * seconds


def repeat_command(plan, run, number, folder):
    """Runs a row again in a folder of its own and evaluates it there."""
    status = read_json_if(folder / "status.json") or {}
    again = f"row-{number}"
    command = results.rerun_command(plan, run, status, again)
    evaluation = (read_json_if(folder / "evaluation_status.json") or {}).get("command")
    if not command or not evaluation:
        return command
    evaluation = results.with_output(evaluation, f"{again}/evaluation")
    evaluation[1] = f"{again}/trajectory.tum"
    return f"{command}; {shlex.join(evaluation)}"  # also of a run that got lost


def collect(plan):
    """The rows of all runs; all have the same keys in the same order."""
    study = plan.suite
    points = {point.name: point for point in study.points}
    rows = []
    for number, (run, base) in enumerate(zip(plan.runs, results.collect(plan)), 1):
        folder, point = plan.places.output / run.folder, points[run.configuration.name]
        program = (read_json_if(folder / "status.json") or {}).get("program", {})
        rows.append({
            "row": number, "point": point.name, "marks": "; ".join(point.marks),
            "in_design": int(point.in_design), "sequence": run.sequence.name,
            "group": run.sequence.group, "seed": run.sequence.seed or None,
            **level_values(study, point, base),
            **{key: value for key, value in base.items() if key not in LEFT_OUT},
            "cpu_ms_per_data_second": milliseconds(base["cpu_s_per_data_second"]),
            **window_values(folder), **flag_values(folder),
            "program": program.get("version"), "program_digest": program.get("digest"),
            "config": f"{run.folder}/result/config.yaml",
            "command": repeat_command(plan, run, number, folder)})
    # A run that left nothing must not decide what the columns are.
    names = list(dict.fromkeys(key for row in rows for key in row))
    return [{name: row.get(name) for name in names} for row in rows]
