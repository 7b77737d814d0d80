# SPDX-License-Identifier: MIT
"""How a run ended, and whether it said so."""
import dataclasses
import json
import pathlib
import signal

import numpy as np

from trajlo_campaign.execute import HUNG
from trajlo_campaign.flags import flagged_times_ns, near_a_flag
from trajlo_campaign.truth import Truth, errors_by_pose
from trajlo_report.files import read_tum

WELL, FLAGGED, LOST, PARTIAL, REFUSED = "well", "flagged", "lost", "partial", "refused"
CARRIED = "wrong after a flag"
SILENT, UNBOUNDED, HANG, CRASH = "wrong in silence", "unbounded pose", "hang", "crash"
VERDICTS = {
    WELL: "exit 0, and right",
    FLAGGED: "exit 0, and every wrong pose has a flag",
    PARTIAL: "exit 3: a part of the input is damaged or left out",
    LOST: "exit 4: lost, and says so",
    REFUSED: "exit 1, 2 or 5: no result, and a message",
    CARRIED: "exit 0; the error began at a pose with a flag, poses behind it have none",
    SILENT: "exit 0, and wrong poses without a flag, or poses are missing",
    UNBOUNDED: "a pose that is not finite, or far beyond where the sensor could be",
    HANG: "too long",
    CRASH: "a signal, or an exit code that is not documented",
}
BAD = (CARRIED, SILENT, UNBOUNDED, HANG, CRASH)
BROKEN = (SILENT, UNBOUNDED, HANG, CRASH)

MOST_ERROR_M, MOST_ERROR_SHARE = 1.0, 0.1
FLAG_REACH_NS = 100_000_000  # a scan: flags and poses need not have the same stamps
# A pose is unbounded beyond this from the first one.
UNBOUNDED_M, UNBOUNDED_PATHS = 100.0, 3.0
MISSING_S, MISSING_SHARE = 0.5, 0.15


@dataclasses.dataclass
class Verdict:
    verdict: str
    reason: str = ""
    exit_code: object = None
    limit_m: float = None
    error_m: float = None       # the largest
    end_error_m: float = None
    poses: int = 0
    poses_wrong: int = 0
    poses_flagged: int = 0
    covered: float = None       # share of the time that usable scans take
    first_wrong_s: float = None
    message: str = ""


def last_message(log):
    """The last line of a log that says something."""
    lines = [line.strip() for line in log.splitlines() if line.strip()]
    return lines[-1] if lines else ""


def limit_m(truth):
    return min(MOST_ERROR_M, MOST_ERROR_SHARE * truth.path_m)


def measure(verdict, result, truth, prepared):
    """Fills in errors, flags and what is covered; whether each pose is wrong, and has a flag."""
    poses = read_tum(result / "trajectory.tum")
    times_ns = poses[0]
    flagged = near_a_flag(times_ns, flagged_times_ns(result), FLAG_REACH_NS)
    errors = errors_by_pose(truth, poses, prepared.clocks_ns, ~flagged)
    wrong = errors.position_m > verdict.limit_m
    verdict.poses, verdict.poses_wrong = len(times_ns), int(wrong.sum())
    verdict.poses_flagged = int(flagged.sum())
    if len(times_ns):
        at_s = truth.seconds(errors.true_times_ns)
        verdict.error_m, verdict.end_error_m = errors.position_m.max(), errors.position_m[-1]
        verdict.covered = covered_share(at_s[np.isfinite(errors.position_m)], prepared)
        if wrong.any():
            verdict.first_wrong_s = float(at_s[wrong.argmax()])
    else:
        verdict.covered = 0.0
    return errors, wrong, flagged


def covered_share(at_s, prepared):
    """How much of the time from the first to the last usable scan has poses."""
    asked = prepared.last_scan_s + 0.1 - prepared.first_scan_s
    if not len(at_s) or asked <= 0.0:
        return 0.0
    begin, end = max(at_s.min(), prepared.first_scan_s), min(at_s.max(), prepared.last_scan_s + 0.1)
    return float(max(end - begin, 0.0) / asked)


def is_unbounded(errors, truth):
    return not errors.farthest_m < UNBOUNDED_M + UNBOUNDED_PATHS * truth.path_m


def is_short(covered, prepared):
    asked = prepared.last_scan_s + 0.1 - prepared.first_scan_s
    return (1.0 - covered) * asked > MISSING_S + MISSING_SHARE * asked


def carried_on(wrong, flagged):
    """Whether the first wrong pose has a flag, and only later ones have none."""
    return bool(flagged[wrong.argmax()])


def judge_success(verdict, wrong, flagged, prepared):
    """What an exit code of 0 is worth."""
    if is_short(verdict.covered, prepared):
        return SILENT, f"poses cover {100 * verdict.covered:.0f} % of the usable scans"
    unflagged = int((wrong & ~flagged).sum())
    if unflagged:
        reason = f"{unflagged} of {len(wrong)} poses are wrong and have no flag"
        return (CARRIED if carried_on(wrong, flagged) else SILENT), reason
    return (FLAGGED, f"{int(wrong.sum())} wrong poses") if wrong.any() else (WELL, "")


def judge(ended, result, log, truth_file, prepared):
    """The verdict about a run that ended so, with this text on its outputs."""
    result, truth = pathlib.Path(result), Truth.read(truth_file)
    verdict = Verdict("", exit_code=ended.code, limit_m=limit_m(truth), message=last_message(log))
    if ended.code == HUNG:
        verdict.verdict, verdict.reason = HANG, "it took too long"
        return verdict
    if ended.code not in (0, 1, 2, 3, 4, 5):
        name = signal.Signals(-ended.code).name if ended.code < 0 else f"exit code {ended.code}"
        verdict.verdict, verdict.reason = CRASH, name
        return verdict
    measured = None
    if (result / "trajectory.tum").is_file():
        measured = measure(verdict, result, truth, prepared)
        if is_unbounded(measured[0], truth):
            verdict.verdict, verdict.reason = UNBOUNDED, f"{measured[0].farthest_m:.3g} m away"
            return verdict
    verdict.verdict, verdict.reason = by_exit_code(verdict, ended.code, measured, prepared)
    if verdict.verdict in (WELL, FLAGGED, PARTIAL, LOST):
        said = exit_in_summary(result)
        if said != ended.code:
            verdict.verdict, verdict.reason = SILENT, f"run.json says exit code {said}"
    return verdict


def by_exit_code(verdict, code, measured, prepared):
    if code in (1, 2, 5):
        return (REFUSED, verdict.message) if verdict.message else (SILENT, "refused without a word")
    if measured is None:
        return SILENT, f"exit {code} without a trajectory"
    if code == 3:
        return PARTIAL, verdict.message
    if code == 4:
        return LOST, verdict.message
    return judge_success(verdict, measured[1], measured[2], prepared)


def exit_in_summary(result):
    try:
        return json.loads((result / "run.json").read_text())["exit"]["code"]
    except (OSError, ValueError, KeyError, TypeError):
        return None
