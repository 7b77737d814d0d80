# SPDX-License-Identifier: MIT
"""What an evaluation says, in sentences."""
from trajlo_report.run_summary import length

ALIKE = 0.03  # shares of the truth that are covered; as trajlo_evaluate has it


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


def of_shares(estimates):
    """Errors over different parts of the truth do not compare."""
    shares = [estimate.metrics.get("completeness") for estimate in estimates
              if not estimate.diverged]
    shares = [share for share in shares if share is not None]
    if not shares or max(shares) - min(shares) <= ALIKE:
        return []
    return [f"The estimates cover different shares of the truth ({100 * min(shares):.1f} to "
            f"{100 * max(shares):.1f} %), so none is called the best."]


def conclusions(estimates):
    """A sentence for each estimate, the best first; those that diverged or have no error last."""
    def error(estimate):
        ate = (estimate.metrics.get("ate") or {}).get("translation_m")
        return (not ate or estimate.diverged, ate["rmse"] if ate else 0.0)
    said = [of_estimate(estimate) for estimate in sorted(estimates, key=error)]
    return [*said, *of_shares(estimates)]
