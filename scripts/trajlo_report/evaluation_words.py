# SPDX-License-Identifier: MIT
"""What an evaluation says, in sentences."""
from trajlo_report.run_summary import length


def of_estimate(estimate):
    metrics = estimate.metrics
    ate = (metrics.get("ate") or {}).get("translation_m")
    if not ate:
        return f"{estimate.name} cannot be compared with the truth."
    if estimate.diverged:
        return f"{estimate.name} diverged."
    text = (f"{estimate.name} is {length(ate['rmse'])} from the truth (root mean square after "
            f"alignment; at most {length(ate['max'])})")
    if metrics.get("path_length_m"):
        text += f" over a path of {length(metrics['path_length_m'])}"
    return f"{text}."


def conclusions(estimates):
    """A sentence for each estimate, the best first; those that diverged or have no error last."""
    def error(estimate):
        ate = (estimate.metrics.get("ate") or {}).get("translation_m")
        return (not ate or estimate.diverged, ate["rmse"] if ate else 0.0)
    return [of_estimate(estimate) for estimate in sorted(estimates, key=error)]
