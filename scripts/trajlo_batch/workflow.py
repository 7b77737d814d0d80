# SPDX-License-Identifier: MIT
"""Starts Snakemake on the jobs of a plan, and shows how far it is."""
import fcntl
import os
import signal
import subprocess
import sys

from trajlo_batch import results
from trajlo_batch.places import ROOT
from trajlo_batch.progress import ProgressBar, ProgressLines
from trajlo_batch.yaml_lines import SuiteError
from trajlo_report.files import make_folder, writing

WORKFLOW = ROOT / "scripts" / "workflow"


def lock(output):
    """Holds OUTPUT until this process ends, in whichever way; its jobs end with it."""
    make_folder(output)
    with writing(output / ".batch_lock"):
        file = (output / ".batch_lock").open("w")
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        raise SuiteError(f"another batch is at work in {output}; wait for it, or choose another "
                         "--output") from error
    return file


def snakemake_command(output, jobs, slurm, sbatch):
    command = ["setpriv", "--pdeathsig", "KILL", "snakemake", "--snakefile", WORKFLOW / "Snakefile",
               "--directory", output, "--config", f"jobs={output / 'jobs.json'}",
               "--keep-going", "--rerun-triggers", "mtime",
               # All jobs make their files beside and rename them: what is there is whole, even if
               # Snakemake was killed before it took note.
               "--ignore-incomplete",
               # The lock of this batch is freed when it is killed; Snakemake's own is not.
               "--nolock", "--nocolor", "--scheduler", "greedy"]
    if not slurm:
        return command + ["--cores", str(jobs)]
    logs = output / "slurm"
    logs.mkdir(exist_ok=True)
    submit = f"sbatch --parsable --cpus-per-task={{threads}} --output={logs}/%j.log {sbatch}"
    return command + ["--jobs", str(jobs), "--cluster", submit.strip(),
                      "--cluster-status", WORKFLOW / "slurm_status.py",
                      "--cluster-cancel", "scancel", "--latency-wait", "60"]


class Watch:
    """What has become of the runs of a plan so far."""

    def __init__(self, plan):
        self.plan, self.ended = plan, {}

    def look(self):
        """{what a run is called: Ended} of those that have been judged, and how many have all that
        belongs to them, in a batch a page."""
        output, suite = self.plan.places.output, self.plan.suite
        for run in self.plan.runs:
            name = suite.described(run)
            found = None if name in self.ended else results.ended(output / run.folder)
            if found:
                self.ended[name] = found
        complete = sum((output / run.folder / suite.goal).is_file() for run in self.plan.runs)
        return self.ended, complete


def work(plan, jobs, slurm=False, sbatch=""):
    """Lets Snakemake do what is missing; its log is OUTPUT/snakemake.log. Returns its exit code."""
    output = plan.places.output
    shown = ProgressBar if sys.stderr.isatty() else ProgressLines
    watch = Watch(plan)
    bar = shown(len(plan.runs), watch.look()[0], sys.stderr)
    with (output / "snakemake.log").open("a") as log:
        process = subprocess.Popen(snakemake_command(output, jobs, slurm, sbatch), stdout=log,
                                   stderr=subprocess.STDOUT, start_new_session=True)
        try:
            while True:
                bar.update(*watch.look())
                try:
                    return process.wait(0.5)
                except subprocess.TimeoutExpired:
                    pass
        except KeyboardInterrupt:
            # To Snakemake and all of its jobs, once: runs flush and end, then Snakemake does.
            os.killpg(process.pid, signal.SIGINT)
            process.wait()
            raise
        finally:
            bar.update(*watch.look())
            bar.close()
