#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Tells Snakemake how a Slurm job is: running, success or failed. Called with the job's number."""
import subprocess
import sys

RUNNING = {"PENDING", "CONFIGURING", "RUNNING", "COMPLETING", "SUSPENDED", "REQUEUED", "STOPPED",
           "RESIZING", "SIGNALING", "STAGE_OUT", "REQUEUE_HOLD", "REQUEUE_FED", "SPECIAL_EXIT"}


def ask(*command):
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    return done.stdout if done.returncode == 0 else ""


def state(job):
    """From the controller, which forgets jobs after some minutes, else from the accounting."""
    for word in ask("scontrol", "--oneliner", "show", "job", job).split():
        if word.startswith("JobState="):
            return word.partition("=")[2]
    words = ask("sacct", "--jobs", job, "--format", "State", "--noheader", "--allocations").split()
    return words[0] if words else "UNKNOWN"


if __name__ == "__main__":
    found = state(sys.argv[1])
    print("success" if found == "COMPLETED" else "running" if found in RUNNING else "failed")
