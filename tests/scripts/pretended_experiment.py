# SPDX-License-Identifier: MIT
"""An experiment as if all of its runs had ended, with errors that a function says."""
import json

from support import FolderTest

from trajlo_batch import plan
from trajlo_batch.places import Places
from trajlo_experiment.experiment import read_experiment
from trajlo_experiment.points import make_study, save_design

WINDOWS = """points,inlier_share,rounds,iterations,rejected_steps,smallest_eigenvalue,flag_names
100,0.9,2,3,1,0.2,
50,0.5,4,5,2,0.1,degenerate
"""
FLAGS = """t_s,flags,flag_names
1.0,0,
1.1,0,
4.0,2,gap
4.1,16,degenerate
"""
SMALL = """
design: {kind: grid}
vary:
  window.segments: [3, 5]
  expert.registration.kernel: [none, huber]
marks:
  defaults: {}
  chosen: {window.segments: 5, expert.registration.kernel: none}
sequences:
  - simulate: hall_os1_16
    seeds: [1, 2]
"""
# Totals of the whole run, of which the truth covers the half.
RUN = {"exit": {"code": 0, "reason": "ok"}, "result": {"duration_s": 4.0, "poses_flagged": 2},
       "windows": {"inlier_share": 0.6}}


def evaluation(error):
    return {"estimates": [{
        "diverged": error is None, "pairs": 10, "duration_s": 2.0, "completeness": 1.0,
        "divergence_reason": "too far" if error is None else "",
        "ate": {"translation_m": {"rmse": error or 9.0}, "rotation_deg": {"rmse": 1.0}},
        "rpe": [{"delta": 1.0, "unit": "m", "translation_m": {"rmse": 0.1}}]}]}


class PretendedTest(FolderTest):
    def setUp(self):
        super().setUp()
        self.places = Places(self.pretend_build(), self.folder / "data", self.folder / "out")

    def batch(self, text):
        """The plan of an experiment file with this text."""
        study = make_study(read_experiment(self.write("e.yaml", text)), self.places)
        return plan.make_plan(study, self.places)

    def finish(self, batch, error_of, cpu_of=lambda levels: 1.0):
        """error_of(levels, group, seed) is an error (m), or None for a run that diverged."""
        save_design(batch.suite, self.places.output)
        plan.write_plan(batch, keep_recordings=True)
        levels = {point.name: point.levels for point in batch.suite.points}
        for run in batch.runs:
            own, sequence = levels[run.configuration.name], run.sequence
            self.write_run(run, error_of(own, sequence.group, sequence.seed), cpu_of(own))

    def write_run(self, run, error, cpu_s):
        folder = f"out/{run.folder}"
        result, program = self.places.output / run.folder / "result", run.job["program"]
        self.write(f"{folder}/status.json", json.dumps({
            "depends_on": run.job["depends_on"], "exit_code": 0, "reason": "ok", "cpu_s": cpu_s,
            "wall_s": 1.0, "program": program,
            "command": [program["path"], f"--output={result}", "--threads=1"]}))
        self.write(f"{folder}/evaluation_status.json", json.dumps({
            "exit_code": 0, "reason": "", "command": [
                "trajlo_evaluate", str(result / "trajectory.tum"), "--truth=t.tum",
                f"--output={result.parent / 'evaluation'}"]}))
        self.write(f"{folder}/evaluation/evaluation.json", json.dumps(evaluation(error)))
        self.write(f"{folder}/result/windows.csv", WINDOWS)
        self.write(f"{folder}/result/flags.csv", FLAGS)
        self.write(f"{folder}/result/run.json", json.dumps(RUN))
