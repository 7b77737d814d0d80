# SPDX-License-Identifier: MIT
"""One job of a batch, as Snakemake calls it: python3 -m trajlo_batch STEP ARGUMENT..."""
import sys

from trajlo_batch import steps

STEPS = {"simulate": steps.simulate, "run": steps.run, "evaluate": steps.evaluate,
         "draw": steps.draw}

if __name__ == "__main__":
    try:
        STEPS[sys.argv[1]](*sys.argv[2:])
    except steps.StepError as error:
        sys.exit(f"{sys.argv[1]}: {error}")
