# SPDX-License-Identifier: MIT
"""What a comparison of solvers says, in sentences: conclusions, and what figures leave out."""
import pathlib

from trajlo_report import files, run_summary
from trajlo_report.names import counted
from trajlo_report.window_times import alike

SAME_M = 1e-6  # as trajlo_compare_solvers: trajectories that are nearer count as the same


def listed(names):
    """ "a, b and c" """
    names = list(names)
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"


def significant(value):
    """Two digits, without an exponent."""
    return f"{float(f'{value:.2g}'):g}"


def small_length(metres):
    """Lengths down to those of rounding."""
    if metres <= 1e-9:
        return "≤ 1 nm"
    for unit, size in (("nm", 1e-9), ("µm", 1e-6), ("mm", 1e-3)):
        if metres < 999.5 * size and metres < 0.01:
            return f"{significant(metres / size)} {unit}"
    return run_summary.length(metres)


def factor(value):
    return f"{value:.0f}" if value >= 10 else f"{value:.1f}"


def of_end(document):
    """A comparison that a signal ended or that is still running must not read as a finished one."""
    if document.get("is_whole", True):
        return []
    return ["The comparison did not finish: the last run is not whole, and variants may "
            "be missing."]


def agreement(items, distance_of, what):
    """Which agree with the first, and how far the farthest is from it; `what`: many do, one does."""
    if len(items) < 2:
        return []
    first, others = items[0]["name"], items[1:]
    same = [item["name"] for item in others if distance_of(item) <= SAME_M]
    far = max(others, key=distance_of)
    count = (f"{len(same)} of {len(others)}" if len(same) < len(others)
             else "All" if len(same) > 1 else same[0])
    text = f"{count} {what[len(same) == 1]} that of {first} to within a micrometre"
    if len(same) < len(others):
        text += f"; the farthest, {far['name']}, differs by {small_length(distance_of(far))}"
    return [text + "."]


def changes_energy(variant):
    """Kernels change the energy itself: costs, times and solutions do not compare."""
    return "kernel" in variant["set"]


def speed(items, table):
    """Who is fastest and who is slowest, where that is more than noise."""
    ms_of = {item["name"]: item["lockstep"]["median_total_ms"] for item in items}
    first, fastest, slowest = items[0]["name"], min(ms_of, key=ms_of.get), max(ms_of, key=ms_of.get)
    least, most = ms_of[fastest], ms_of[slowest]
    fast = [name for name in ms_of if alike(table, fastest, name)]
    slow = [name for name in ms_of if alike(table, slowest, name) and name not in fast]
    if not slow:
        who = listed(ms_of) if len(ms_of) < 4 else f"All {len(ms_of)} variants"
        low, high = significant(least), significant(most)
        return (f"{who} are alike in speed: for a window they take "
                f"{f'about {low}' if low == high else f'{low} to {high}'} ms, and differ by no "
                "more than noise does.")
    text = (f"{listed(fast)} solve{'s' if len(fast) == 1 else ''} a window fastest, in "
            f"{'' if len(fast) == 1 else 'about '}{significant(least)} ms")
    if first not in fast:
        text += f" ({first} takes {factor(ms_of[first] / least)} × as long)"
    return (f"{text}; {listed(slow)} {'is' if len(slow) == 1 else 'are'} slowest, "
            f"{factor(most / least)} × as long.")


def of_windows(lockstep, table):
    """`table`: the columns of lockstep.csv."""
    same_cost = [item for item in lockstep if not changes_energy(item)]
    if len(same_cost) < 2:
        return []
    said = [speed(same_cost, table),
            # Distances are from the first of all, which must minimise the same cost.
            *agreement(same_cost if same_cost[0] is lockstep[0] else [],
                       lambda item: item["lockstep"]["max_from_first_m"],
                       ("find a solution that equals", "finds a solution that equals"))]
    others = [item["name"] for item in lockstep if changes_energy(item)]
    if others:
        one = len(others) == 1
        without = "this sentence leaves" if len(said) == 1 else "these two sentences leave"
        said.append(f"{listed(others)} {'minimises' if one else 'minimise'} another cost, so "
                    f"{without} {'it' if one else 'them'} out.")
    return said


def by_whole_runs_only(variants):
    """Why some variants are not among those that solve the same windows."""
    lockstep = [item["name"] for item in variants if "lockstep" in item]
    others = [item["name"] for item in variants if "lockstep" not in item]
    if not lockstep or not others:
        return []
    one = len(others) == 1
    return [f"{listed(others)} {'is' if one else 'are'} not among the windows, as "
            f"{'it changes' if one else 'they change'} more than how a window of {lockstep[0]} is "
            "solved, such as windows or segments themselves: only whole runs compare "
            f"{'it' if one else 'them'}."]


def few_poses(item):
    """Whether most poses of a run are at other times than those of the first."""
    return 2 * item["free"]["poses_compared"] < item["free"]["poses"]


def of_runs(free):
    if len(free) < 2:
        return []
    others = [item for item in free if few_poses(item)]
    said = agreement([item for item in free if item not in others],
                     lambda item: item["free"]["max_from_first_m"],
                     ("end with a trajectory that equals", "ends with a trajectory that equals"))
    if others:
        said.append(f"{listed([item['name'] for item in others])}: most poses are at other times "
                    f"than those of {free[0]['name']}, as segments differ. Only the few at the same "
                    "times are compared, in the table below.")
    lost = [item["name"] for item in free if item["free"].get("lost_at_s")]
    if lost:
        said.append(f"{listed(lost)} got lost.")
    errors = {item["name"]: item["free"]["ate_rmse_m"] for item in free
              if item["free"].get("ate_rmse_m") is not None}
    if len(errors) > 1:
        best, worst = min(errors, key=errors.get), max(errors, key=errors.get)
        if errors[worst] < 1.02 * errors[best]:
            said.append(f"The position errors are alike ({small_length(errors[best])}).")
        else:
            said.append(f"Position errors range from {small_length(errors[best])} ({best}) to "
                        f"{small_length(errors[worst])} ({worst}).")
        if any(item["free"].get("truth_warnings") for item in free):
            said.append("Whether these errors are those of the runs is in doubt: see the warnings.")
    return said


def compared(item):
    """How much of a run stands behind its error."""
    free = item["free"]
    if free.get("truth_pairs") is None:
        return "–"
    return f"{counted(free['truth_pairs'], 'pose')}, {100 * free['truth_covered_share']:.0f} % of the time"


def since_begin(folder, item):
    """When a run left that of the first variant, in seconds after its begin."""
    at = item["free"].get("parts_at_s")
    if at is None:
        return None
    times, _, _ = files.read_poses(pathlib.Path(folder) / item["free"]["trajectory"])
    # The begin is not worth more digits than the time of a pose.
    return max(float(at) - times[0], 0.0)
