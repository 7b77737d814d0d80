# SPDX-License-Identifier: MIT
"""A small suite, planned with programs that only pretend."""
import json

from support import FolderTest

from trajlo_batch import plan
from trajlo_batch.places import Places
from trajlo_batch.suite import read_suite

SUITE = """
sequences:
  - simulate: hall_os1_16
configurations:
  - name: plain
  - name: varied
    set: {window.segments: 3}
"""


class PlannedTest(FolderTest):
    def setUp(self):
        super().setUp()
        self.places = Places(self.pretend_build(), self.folder / "data", self.folder / "out")

    def plan(self, text=SUITE, **options):
        return plan.make_plan(read_suite(self.write("s.yaml", text)), self.places, **options)

    def finish(self, batch, exit_code=0):
        """As if all runs of a plan had ended."""
        plan.write_plan(batch, keep_recordings=True)
        for run in batch.runs:
            (self.places.output / run.folder / "status.json").write_text(json.dumps(
                {"depends_on": run.job["depends_on"], "exit_code": exit_code, "reason": "ok"}))
