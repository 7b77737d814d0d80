# SPDX-License-Identifier: MIT
"""What the command lines of batches and experiments share."""
import argparse
import os
import pathlib
import re
import shlex
import signal
import sys

from trajlo_batch import results
from trajlo_batch.places import BUILD, ROOT, WORK, Places
from trajlo_batch.plan import DONE
from trajlo_batch.yaml_lines import SuiteError
from trajlo_report.command_line import (  # noqa: F401
    Parser, positive, sentence, unless_unread)
from trajlo_report.files import WriteError
from trajlo_report.names import counted


def add_work_arguments(parser, run_name):
    """Where to work, on what, and how; `run_name` says how users name a run."""
    parser.add_argument("-j", "--jobs", type=positive, default=len(os.sched_getaffinity(0)),
                        help="cores to use, with --slurm jobs at a time; default: all cores")
    parser.add_argument("--output", type=pathlib.Path,
                        help="default: the name of the file, below $TRAJLO_RUNS or else runs/ of "
                        "the project (of an installation: of the current folder)")
    parser.add_argument("--data", type=pathlib.Path,
                        default=os.environ.get("TRAJLO_DATASETS", WORK / "data"),
                        help="the folder of data sets; default: $TRAJLO_DATASETS, else data/ "
                        "beside runs/")
    add_build_argument(parser)
    parser.add_argument("--list", action="store_true", help="show the runs and stop")
    parser.add_argument("--command", metavar=run_name.upper(),
                        help="print how to repeat a run and stop")
    parser.add_argument("--report", action="store_true", help="only rewrite tables and page")
    parser.add_argument("--retry", action="store_true", help="repeat runs that failed, got lost or timed out")
    parser.add_argument("--any-version", action="store_true",
                        help="keep runs of other builds of the programs")
    parser.add_argument("--drop-recordings", action="store_true",
                        help="delete each simulated recording as soon as its runs are done")
    parser.add_argument("--slurm", action="store_true", help="submit the jobs with sbatch")
    parser.add_argument("--sbatch", default="", metavar="ARGUMENTS", help="more arguments for sbatch")


def add_build_argument(parser):
    parser.add_argument("--build", type=pathlib.Path,
                        default=os.environ.get("TRAJLO_BUILD_DIR", BUILD),
                        help="the build to run; default: $TRAJLO_BUILD_DIR, else build/")


def default_output(name):
    return pathlib.Path(os.environ.get("TRAJLO_RUNS", WORK / "runs")) / name


def places_of(arguments, name):
    output = arguments.output or default_output(name)
    return Places(arguments.build.resolve(), arguments.data.resolve(), output.resolve())


def call_of(script, kind, file, places):
    """How this script was called with this file, from the folder where it was, as far as others
    have to call it so to find the same results."""
    of_project = file.parent == ROOT / "config" / kind
    default = default_places(file.stem)
    more = [f"--{name}={getattr(places, name)}" for name in ("output", "data", "build")
            if getattr(places, name) != getattr(default, name)]
    return shlex.join([f"scripts/{script}", file.stem if of_project else str(file), *more])


def default_places(name):
    """The places where nothing is said about them."""
    parser = argparse.ArgumentParser()
    add_work_arguments(parser, "run")
    return places_of(parser.parse_args([]), name)


def alike(missing):
    """Sequences whose files differ by their names only, in one: {paths: names}."""
    patterns = {}
    for name, paths in missing.items():
        word = re.compile(rf"(?<![A-Za-z0-9]){re.escape(name)}(?![A-Za-z0-9])")
        patterns.setdefault(tuple(word.sub("NAME", path) for path in paths), []).append(name)
    return {tuple(missing[names[0]]) if len(names) == 1 else pattern: names
            for pattern, names in patterns.items()}


def say_missing(suite, missing):
    """Which sequences have no data, what was looked for, and where to download the data."""
    if not missing:
        return
    for paths, names in alike(missing).items():
        print(f"{', '.join(names)}: no data; looked for {', '.join(paths)}", file=sys.stderr)
    print(f"No data for {len(missing)} of {counted(len(suite.sequences), 'sequence')}. --data or "
          f"TRAJLO_DATASETS names the folder that holds them. {suite.needs}".rstrip(),
          file=sys.stderr)
    helper = ROOT / "scripts" / "datasets" / suite.name
    if helper.is_file():
        print(f"scripts/datasets/{suite.name} --help says where to download them and how to put "
              "them in place.", file=sys.stderr)


def show_list(plan):
    for number, run in enumerate(plan.runs, 1):
        changes = run.changes or run.outdated
        why = f" ({', '.join(changes)} changed)" if changes else ""
        ended = results.ended(plan.places.output / run.folder) if run.state == DONE else None
        failed = ended and ended.result == results.FAILED
        print(f"{number:4} {results.FAILED if failed else run.state:8} {plan.suite.described(run)}"
              f"{f' ({ended.reason})' if failed else why}")


def interrupt(*_):
    raise KeyboardInterrupt


def guarded(parser, work, how_to_go_on="the same command goes on where this one stopped"):
    """Calls work(arguments) and turns what goes wrong into messages and exit codes."""
    signal.signal(signal.SIGTERM, interrupt)
    arguments = parser.parse_args()
    try:
        return unless_unread(work, arguments)
    except SuiteError as error:
        print(f"{parser.prog}: {error}", file=sys.stderr)
        return 1
    except OSError as error:
        cannot = "be written" if isinstance(error, WriteError) else "be read or written"
        print(f"{parser.prog}: {sentence(error, cannot)}", file=sys.stderr)
        return 5
    except KeyboardInterrupt:
        print(f"interrupted; {how_to_go_on}", file=sys.stderr)
        return 130
