# SPDX-License-Identifier: MIT
"""A run in a few sentences and numbers, for people."""
import dataclasses

import numpy as np

from trajlo_report import names, view_path

VERDICTS = {
    0: "The run ended well.",
    3: "The run ended, but a part of the input was damaged or left out, or poses are in doubt.",
    4: "The estimator got lost: do not trust poses from there on.",
    5: "The output could not be written completely.",
    6: "The run failed.",
    130: "The run was interrupted; what it had done by then is shown.",
}


@dataclasses.dataclass
class Fact:
    value: str
    text: str


def lost_verdict(result):
    """When the estimator got lost, counted from the start."""
    lost, begin = result.get("lost_at_s"), result.get("begin_s")
    if lost is None or begin is None:
        return VERDICTS[4]
    return (f"The estimator got lost {float(lost) - float(begin):.1f} s after the start: do not "
            "trust poses from there on.")


def verdict(run_json):
    ended = run_json.get("exit", {})
    if ended.get("reason") == "lost":
        return lost_verdict(run_json.get("result", {}))
    known = VERDICTS.get(ended.get("code"))
    if ended.get("reason") == "running" or not ended:
        known = "The run did not finish; what it had done by then is shown."
    message = ended.get("message") or ""
    text = known or f"The run failed: {ended.get('reason')}."
    return f"{text} {message[0].upper()}{message[1:]}." if message else text


def length(metres):
    if metres >= 1000:
        return f"{metres / 1000:.2f} km"
    if metres < 0.00995:
        return f"{1000 * metres:.1f} mm"
    return f"{metres:.0f} m" if metres >= 100 else f"{metres:.1f} m" if metres >= 1 else (
        f"{100 * metres:.1f} cm")


def of_input(run_json):
    result, scans = run_json.get("result", {}), run_json.get("input", {}).get("scans", {})
    if not result.get("duration_s"):
        return []
    read, listed = scans.get("read", 0), scans.get("listed", 0)
    count = names.counted(listed, "scan")
    if read != listed:
        count = f"{read} of {count}"
    if scans.get("damaged"):
        count += f", {scans['damaged']} of them damaged"
    return [Fact(f"{result['duration_s']:.1f} s", f"of data, {count}")]


def of_path(run_json, run):
    result = run_json.get("result", {})
    if run is None or "path_length_m" not in result:
        return []
    fastest = np.percentile(view_path.speeds(run.times, run.positions), 99)
    return [Fact(length(result["path_length_m"]),
                 f"travelled, at up to {fastest:.1f} m/s; the end is "
                 f"{length(result['distance_to_start_m'])} from the start")]


def of_error(run):
    ate = ((run.estimate.metrics.get("ate") or {}).get("translation_m")
           if run is not None and run.estimate is not None else None)
    if not ate:
        return []
    return [Fact(length(ate["rmse"]), "position error (root mean square) against the truth after "
                 f"alignment; at most {length(ate['max'])}")]


def of_windows(run_json):
    windows = run_json.get("windows", {})
    if not windows.get("count"):
        return []
    return [Fact(f"{100 * windows['inlier_share']:.0f} %", "of the points found a plane in the map")]


def of_flags(run_json):
    """Of the poses: a gap has no window."""
    result = run_json.get("result", {})
    if not run_json.get("windows", {}).get("count") or "poses_flagged" not in result:
        return []
    said = ", ".join(f"{name.replace('_', ' ')} {total['poses']} ({total['seconds']:.2f} s)"
                     for name, total in result["flagged"].items() if total["poses"])
    if not said:
        return [Fact("none", "of the poses is flagged")]
    return [Fact(str(result["poses_flagged"]),
                 f"{'pose is' if result['poses_flagged'] == 1 else 'poses are'} flagged: {said}")]


def of_resources(run_json):
    resources, result = run_json.get("resources", {}), run_json.get("result", {})
    if not resources.get("cpu_s") or not result.get("duration_s"):
        return []
    share = resources["cpu_s"] / result["duration_s"]
    return [Fact(f"{share:.2f} s", "of processor time for each second of data (reading and writing "
                 f"included); {resources['peak_memory_mb']:.0f} MB of memory")]


def facts(run_json, run):
    """The numbers that people ask for first; those that are not known are left out."""
    return [*of_input(run_json), *of_path(run_json, run), *of_error(run), *of_windows(run_json),
            *of_flags(run_json), *of_resources(run_json)]
