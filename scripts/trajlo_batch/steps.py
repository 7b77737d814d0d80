# SPDX-License-Identifier: MIT
"""What the jobs of a batch do. A run that fails is a result; only a job that could not tell how
its run ended is an error."""
import datetime
import fcntl
import pathlib
import re
import resource
import shlex
import shutil
import signal
import socket
import subprocess
import time

import yaml

from trajlo_batch.places import read_json_if, write_json
from trajlo_report import names
from trajlo_report.files import ReportError

EXIT_REASONS = {0: "ok", 1: "configuration refused", 2: "input unreadable",
                3: "input damaged, left out in part or in doubt", 4: "estimator lost",
                5: "output not writable", 6: "out of memory, or a defect"}
INTERRUPTED = (130, 143, -signal.SIGINT, -signal.SIGTERM, -signal.SIGHUP)
# Nothing of the method, and another time it may be otherwise: the output was not writable, or the
# program could not be started.
HINDERED = (5, 126, 127)
TIMEOUT = "timeout"
PAGE_POINTS = 300_000  # in the 3-D view of a run: a batch has hundreds of pages


class StepError(Exception):
    """A job cannot do its work; Snakemake will try it again in the next batch."""


def mortal(command):
    """The command, such that it dies with the process that starts it."""
    return ["setpriv", "--pdeathsig", "KILL", *command]


def flags(values):
    return [f"--{name}={value}" for name, value in values.items()]


def simulate_command(job, folder):
    recording = job["recording"]
    command = [job["program"]["path"], f"--scenario={recording['scenario']}",
               f"--output={folder}", f"--seed={recording['seed']}", "--overwrite"]
    if recording["duration_s"]:
        command.append(f"--duration_s={recording['duration_s']}")
    if recording["parameters"]:
        pairs = (f"{key}={value}" for key, value in recording["parameters"].items())
        command.append(f"--set={','.join(pairs)}")
    return command


def simulate(job_file, folder):
    """A recording in `folder`; its truth and scenario stay in ../truth when it is deleted."""
    folder = pathlib.Path(folder)
    beside = folder.with_name(f".{folder.name}.part")
    command = simulate_command(read_json_if(job_file), beside)
    done = subprocess.run(mortal(command), check=False)
    if done.returncode != 0:
        raise StepError(f"the recording could not be simulated: {shlex.join(command)}")
    kept = folder.parent.parent / "truth"
    kept.mkdir(exist_ok=True)
    shutil.copyfile(beside / "scenario.yaml", kept / f"{folder.name}.yaml")
    shutil.copyfile(beside / "truth.tum", kept / f"{folder.name}.tum")
    # Last, and at once: half a recording must never look like a whole one.
    beside.rename(folder)


def chosen(items, indices, what):
    """The items with these indices; all if none is named."""
    if indices and max(indices) >= len(items):
        raise StepError(f"LiDAR {max(indices)} was asked for, but there are {len(items)} {what}")
    return [items[index] for index in indices] if indices else list(items)


def simulated_rig(scenario_file):
    """T_body_lidar of each LiDAR of a simulated recording, as the configuration takes it."""
    scenario = yaml.safe_load(pathlib.Path(scenario_file).read_text())
    rig = []
    while f"lidar{len(rig)}" in scenario:
        values = scenario[f"lidar{len(rig)}"]["T_body_lidar_matrix"]
        rig.append({"matrix": [values[row:row + 4] for row in (0, 4, 8)]})
    return rig


def lists_of_lidars(options):
    """Of all options, those that have a list with an entry for each LiDAR: {section: {key: list}}."""
    return {section: {key: value for key, value in (options.get(section) or {}).items()
                      if isinstance(value, list) and value}
            for section in ("input", "sensor")}


def rig_of(job, output, folder):
    """Inputs of a run, and the options that say which LiDARs they are and where they sit: as its
    options say, or else as they were simulated."""
    lidars = job["lidars"]
    lists = {section: dict(values) for section, values in job["lidar_options"].items()}
    topics = job["topics"] or lists["input"].pop("topics", [])
    options = {}
    if lidars:
        options = {section: {key: chosen(values, lidars, f"values of {section}.{key}")
                             for key, values in found.items()}
                   for section, found in lists.items() if found}
    if "scenario" in job["recording"]:
        rig = lists["sensor"].get("T_body_lidar") or simulated_rig(
            output / "truth" / f"{job['sequence']}.yaml")
        recording = output / "recordings" / job["sequence"]
        inputs = [recording / f"lidar{i}" for i in range(len(rig))] if len(rig) > 1 else [recording]
        inputs = chosen(inputs, lidars, "in the recording")
        options.setdefault("sensor", {})["T_body_lidar"] = chosen(rig, lidars, "in the rig")
    else:
        inputs = job["recording"]["paths"]
        if topics:
            options.setdefault("input", {})["topics"] = chosen(topics, lidars, "topics")
        else:
            inputs = chosen(inputs, lidars, "in the recording")
    files = list(job["config"])
    if options:
        rig_file = folder / "rig.yaml"
        rig_file.write_text("# Which LiDARs this run has, and where they sit.\n"
                            + yaml.safe_dump(options, sort_keys=False, default_flow_style=None))
        files.append(str(rig_file))
    return [str(path) for path in inputs], files


def run_command(job, inputs, files, result):
    command = [job["program"]["path"], f"--input={','.join(inputs)}", f"--output={result}",
               f"--threads={job['threads']}"]
    command += [f"--config={','.join(files)}"] if files else []
    if job["set"]:
        command.append(f"--set={','.join(f'{k}={v}' for k, v in job['set'].items())}")
    if not job["keep_map"]:
        command.append("--noview")
    return command + flags(job["run"])


def last_message(path):
    """What a program said last by its name, else the last line of a log; on one line, with the
    lines below that continue it, but without the summary of a run."""
    lines = path.read_text(errors="replace").rstrip().splitlines()
    begins = [i for i, line in enumerate(lines) if re.match(r"trajlo_\w+: (?!warning)", line)] or [
        i for i, line in enumerate(lines) if not line.startswith(" ")]
    begin = begins[-1] if begins else 0
    end = next((i for i in range(begin + 1, len(lines))
                if not lines[i].startswith(" ") or re.match(r"  [a-z]+  +\S", lines[i])), len(lines))
    return "; ".join(line.strip() for line in lines[begin:end]).replace(":; ", ": ")


def execute(command, log_file, timeout_s):
    """Runs a command that dies with this process; its exit code, negative for a signal."""
    with log_file.open("w") as log:
        process = subprocess.Popen(mortal(command), stdout=log, stderr=subprocess.STDOUT)
        try:
            return process.wait(timeout_s or None)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
            return TIMEOUT


def run(job_file):
    """Runs the odometry and writes status.json beside the job, however the run ended."""
    job_file = pathlib.Path(job_file).resolve()
    job, folder = read_json_if(job_file), job_file.parent
    with (folder / ".run_lock").open("w") as lock:
        # On a cluster, jobs of a batch that was killed live on.
        fcntl.flock(lock, fcntl.LOCK_EX)
        status = read_json_if(folder / "status.json")
        if not status or status["depends_on"] != job["depends_on"]:
            run_alone(job, folder)


def megabytes(usage):
    """The most memory, as run.json has it: Linux counts in KiB."""
    return 1024 * usage.ru_maxrss / 1e6


def run_alone(job, folder):
    result = folder / "result"
    if result.exists():  # of a run that was killed: there is no status.json
        shutil.rmtree(result)
    command, code, reason = [], 1, ""
    started, clock = datetime.datetime.now(datetime.timezone.utc), time.monotonic()
    try:
        inputs, files = rig_of(job, folder.parents[1], folder)
        command = run_command(job, inputs, files, result)
        code = execute(command, folder / "log.txt", job["timeout_s"])
    except StepError as error:
        reason = str(error)
    if code in INTERRUPTED:
        raise StepError("the run was interrupted")
    if code in HINDERED:
        raise StepError(f"the run was hindered: {last_message(folder / 'log.txt')}")
    if not job["keep_map"]:
        (result / "map.ply").unlink(missing_ok=True)
    if code == TIMEOUT:
        code, reason = -signal.SIGKILL, f"longer than {job['timeout_s']} s"
    elif not reason:
        reason = EXIT_REASONS.get(code, f"exit code {code}")
        if code < 0:
            reason = f"crashed: {signal.Signals(-code).name}"
        elif code not in (0, 3, 4):
            reason = f"{reason}: {last_message(folder / 'log.txt')}"
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    write_json(folder / "status.json", {
        "depends_on": job["depends_on"], "exit_code": code, "reason": reason, "command": command,
        "program": job["program"], "started": started.isoformat(timespec="seconds"),
        "wall_s": time.monotonic() - clock, "cpu_s": usage.ru_utime + usage.ru_stime,
        "peak_memory_mb": megabytes(usage), "host": socket.gethostname()})


def evaluate(job_file):
    """Compares the trajectory with the truth; writes evaluation_status.json."""
    job_file = pathlib.Path(job_file).resolve()
    job, folder = read_json_if(job_file), job_file.parent
    output = folder / "evaluation"
    trajectory = folder / "result" / "trajectory.tum"
    status = {"exit_code": None, "reason": "", "command": []}
    if output.exists():
        shutil.rmtree(output)
    if not job["has_truth"]:
        status["reason"] = "no truth"
    elif not trajectory.is_file():
        status["reason"] = "no trajectory"
    else:
        truth = job["truth"] or folder.parents[1] / "truth" / f"{folder.name}.tum"
        command = [job["program"]["path"], str(trajectory), f"--truth={truth}",
                   f"--output={output}", f"--names={folder.parent.name}", "--report=false",
                   *flags(job["flags"])]
        code = execute(command, folder / "evaluation_log.txt", 0)
        if code in INTERRUPTED:
            raise StepError("the evaluation was interrupted")
        if code in HINDERED:
            raise StepError(f"the evaluation was hindered: {last_message(folder / 'evaluation_log.txt')}")
        status.update(exit_code=code, command=command)
        if not (output / "evaluation.json").is_file():
            status["reason"] = f"no evaluation: {last_message(folder / 'evaluation_log.txt')}"
    write_json(folder / "evaluation_status.json", status)


def draw(status_file):
    """The page of a run. Its figures are pictures only, as the pages show them: most of the time
    would go into SVG and PDF of hundreds of runs. draw_run.py makes those of the one that goes
    into a paper."""
    from trajlo_report import run_page  # no other job has to wait for Matplotlib
    folder = pathlib.Path(status_file).resolve().parent
    (folder / "result").mkdir(exist_ok=True)
    evaluation = folder / "evaluation"
    if not (evaluation / "evaluation.json").is_file():
        evaluation = None
    try:
        run_page.write(folder / "result", folder / "page", evaluation,
                       f"{names.title(folder.name)} · {folder.parent.name}", PAGE_POINTS, ("png",))
    except ReportError as error:
        raise StepError(f"no page could be drawn of {folder}: {error}") from error
