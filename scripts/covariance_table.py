#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""How accurate covariances are, in many scenes, at rest and in motion.

  scripts/covariance_table.py --output runs/covariance
simulates each scene at rest and in motion with a few seeds, runs them with `--covariance`, and
prints a table (Markdown): the mean normalised error squared of the change between two poses, so
many seconds apart, divided by its expected value. 1 is right, more is optimistic; see
check_covariance.py for the definition. What is already in the folder is not made again.
Needs Debian's python3-numpy, python3-scipy and python3-yaml.

Exit codes: 0 done, 1 wrong usage, or a run that ended badly, 2 input unreadable, 5 output not
writable.
"""
import pathlib
import subprocess
import sys

import numpy as np

import check_covariance
from trajlo_batch.command_line import add_build_argument
from trajlo_batch.places import programs_in, read_json_if
from trajlo_batch.results import PARTIAL, USABLE, dig
from trajlo_report import command_line, files

SCENARIOS = ("hall_os1_16", "courtyard_os1_16", "office_os0_64", "facade_os1_16", "corridor_vlp16",
             "street_hdl64", "forest_mid360", "stairwell_xt32")
# Parameters of the simulator, the first seed, and seconds.
KINDS = {"at rest": ("motion.kind=still", 1, 8.0),
         "in motion": ("motion.rest_s=1", 11, 10.0)}
BEGIN_S = 1.5  # From when on poses are judged.


def exit_code(result):
    return dig(read_json_if(result / "run.json"), "exit", "code")


def make_run(programs, folder, scenario, kind, seed):
    """The recording and its result, unless they are there. Of one that is in doubt, where the points
    leave a direction open, it is just as well to know how right the covariances are."""
    parameters, _, duration_s = KINDS[kind]
    recording, result = folder / "recording", folder / "result"
    # run.json is there from the start of a run on, and after one that failed.
    if exit_code(result) in USABLE:
        return
    subprocess.run([programs / "trajlo_simulate", f"--scenario={scenario}", f"--seed={seed}",
                    f"--duration_s={duration_s}", f"--set={parameters}", f"--output={recording}",
                    "--overwrite"], check=True, stdout=subprocess.DEVNULL)
    run = subprocess.run([programs / "trajlo_run", f"--input={recording}",
                          f"--config={recording / 'rig.yaml'}", f"--output={result}",
                          "--overwrite", "--covariance", "--quiet"])
    if run.returncode not in USABLE:
        sys.exit(f"covariance_table.py: trajlo_run ended with {run.returncode} on '{recording}'")


def ratios_of(folder, apart_s):
    """Of one run, in the mean over its poses: by part, as check_covariance.PARTS."""
    times, errors, covariances = check_covariance.errors_of(
        folder / "result", folder / "recording" / "truth.tum", apart_s)
    late = times >= BEGIN_S + apart_s
    ratios = []
    for where in check_covariance.PARTS.values():
        e = errors[late][:, where]
        weighted = np.linalg.solve(covariances[late][:, where, where], e[..., None])[..., 0]
        ratios.append(np.mean(np.sum(e * weighted, axis=1)) / e.shape[1])
    rms = np.sqrt(np.mean(np.sum(errors[late]**2 * [1, 1, 1, 0, 0, 0], axis=1)))
    return ratios + [1e3 * rms]


def print_table(rows, aparts):
    print("| scene | |" + "".join(f" {apart:g} s: pose | translation | rotation | rms mm |"
                                  for apart in aparts))
    print("|---|---|" + "---|" * 4 * len(aparts))
    for scenario, kind, values in rows:
        cells = "".join(f" **{pose:.2f}** | {t:.2f} | {r:.2f} | {rms:.1f} |"
                        for pose, t, r, rms in values)
        print(f"| `{scenario}` | {kind} |{cells}")
    if any(kind.endswith("!") for _, kind, _ in rows):
        print("\n! A run ended with exit code 3: most of its poses are flagged.")


def make_parser():
    parser = command_line.Parser(description=__doc__)
    add_build_argument(parser)
    parser.add_argument("--output", type=pathlib.Path, required=True)
    parser.add_argument("--seeds", type=int, default=2, help="of each scene and kind")
    parser.add_argument("--scenarios", nargs="+", default=SCENARIOS)
    parser.add_argument("--apart", nargs="+", type=float, default=[1.0, 3.0],
                        help="seconds between the poses of a pair")
    return parser


def tabulate(arguments):
    rows = []
    for kind, (_, first_seed, _) in KINDS.items():
        for scenario in arguments.scenarios:
            folders = []
            for seed in range(first_seed, first_seed + arguments.seeds):
                folder = arguments.output / kind.replace(" ", "_") / f"{scenario}-s{seed}"
                files.make_folder(folder)
                make_run(programs_in(arguments.build), folder, scenario, kind, seed)
                folders.append(folder)
            is_in_doubt = any(exit_code(folder / "result") == PARTIAL for folder in folders)
            rows.append((scenario, kind + (" !" if is_in_doubt else ""),
                         [np.mean([ratios_of(folder, apart) for folder in folders], axis=0)
                          for apart in arguments.apart]))
    print_table(rows, arguments.apart)
    return 0


if __name__ == "__main__":
    sys.exit(command_line.guarded(make_parser(), tabulate))
