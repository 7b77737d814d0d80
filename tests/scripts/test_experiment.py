# SPDX-License-Identifier: MIT
"""Experiments are read strictly, keep what is done, and say what they do."""
import contextlib
import io
import json
import re
import subprocess
import unittest

from pretended_experiment import SMALL, PretendedTest
from support import ROOT, SCRIPTS

from trajlo_batch import command_line, workflow
from trajlo_batch.yaml_lines import SuiteError
from trajlo_experiment.experiment import read_experiment

ONE_AT_A_TIME = SMALL.replace("grid", "one_at_a_time").replace("[3, 5]", "[3, 4, 5]").replace(
    "expert.registration.kernel: [none, huber]", "rules: {settings: {ours: {}, other: {a.b: 1}}}").replace(
    "expert.registration.kernel: none", "a.b: 2")


class ReadingTest(PretendedTest):
    def refuse(self, text, message):
        with self.assertRaisesRegex(SuiteError, message):
            read_experiment(self.write("e.yaml", text))

    def test_mistakes_are_named_with_their_line(self):
        self.refuse(SMALL.replace("vary", "varry"), "e.yaml:3.*mean vary?")
        self.refuse(SMALL.replace("grid", "gird"), "e.yaml:2: kind is one of grid.* mean 'grid'?")
        self.refuse(SMALL.replace("grid", "sobol"), "samples")
        self.refuse(SMALL.replace("{kind: grid}", "{kind: sobol, samples: 6}"),
                    "e.yaml:2: a Sobol design is balanced for 2, 4, 8.*not 6")
        self.refuse(SMALL.replace("[3, 5]", "{from: 3, to: 5}"),
                    "e.yaml:4: the range of window.segments needs steps")
        self.refuse(SMALL.replace("{kind: grid}", "{kind: grid, samples: 3}"), "samples")
        self.refuse(SMALL + "reference: chosne\n", "defaults, chosen, not chosne; did you mean chosen?")
        self.refuse(SMALL + "heat_maps: [[window.segments, b]]\n", "heat map")
        self.refuse(SMALL + "center: {window.segments: 3}\n", "only one_at_a_time has a center")

    def test_two_factors_cannot_set_the_same_option(self):
        self.refuse(SMALL.replace("expert.registration.kernel: [none, huber]",
                                  "k: {values: [1], keys: {window.segments: 2}}")
                    .replace("expert.registration.kernel: none", "k: 1"), "k and window.segments both set")

    def test_a_recording_without_truth_is_refused(self):
        text = SMALL + "  - {name: real, recording: real.bag}\n"
        self.refuse(text, "e.yaml: .* with the truth, and real has none; name a file in truth")
        read_experiment(self.write("e.yaml", text.replace("real.bag", "real.bag, truth: real.tum")))

    def test_what_a_job_decides_cannot_vary(self):
        self.refuse(SMALL.replace("expert.registration.kernel: [none, huber]", "threads: [1, 2]")
                    .replace("expert.registration.kernel: none", "threads: 1"), "threads cannot vary")

    def test_several_options_at_once_need_a_value_at_the_centre(self):
        text = SMALL.replace("grid", "one_at_a_time").replace(
            "expert.registration.kernel: [none, huber]", "k: {values: [1, 2], keys: {a.b: 2}}").replace(
            "expert.registration.kernel: none", "k: 1")
        self.refuse(text, "k drives several keys and needs a value in center")
        self.assertEqual(read_experiment(self.write("e.yaml", text + "center: {k: 1}\n")).center,
                         {"k": 1})

    def test_an_option_that_does_not_exist_ends_it_before_it_begins(self):
        with self.assertRaisesRegex(SuiteError, "no such option"):
            self.batch(SMALL.replace("expert.registration.kernel", "bad"))

    def test_the_experiments_of_the_project_are_well_formed(self):
        files = sorted((ROOT / "config" / "experiments").glob("*.yaml"))
        self.assertGreaterEqual(len(files), 6)
        for path in files:
            with self.subTest(path.name):
                self.assertTrue(read_experiment(path).question)
                for word in ("# Question:", "# Design:", "# Time:"):
                    self.assertIn(word, path.read_text())


class PointsTest(PretendedTest):
    def points(self, text):
        return self.batch(text).suite.points

    def test_a_mark_on_the_grid_is_no_run_of_its_own(self):
        points = self.points(SMALL)
        self.assertEqual(len(points), 5)
        chosen, = (point for point in points if "chosen" in point.marks)
        self.assertEqual((chosen.in_design, chosen.levels),
                         (True, {"window.segments": 5, "expert.registration.kernel": "none"}))
        self.assertEqual([(point.marks, point.options) for point in points if not point.in_design],
                         [(("defaults",), {})])

    def test_a_mark_that_sets_nothing_but_defaults_is_the_point_of_the_grid_that_does(self):
        points = self.points(SMALL.replace("[3, 5]", "[3, 4]").replace(
            "expert.registration.kernel: [none, huber]", "rules: {settings: {ours: {}, other: {a.b: 1}}}"
        ).replace("window.segments: 5, expert.registration.kernel: none", "window.segments: 4.0"))
        self.assertEqual(len(points), 4)
        self.assertEqual([(point.levels, point.marks) for point in points if point.marks],
                         [({"window.segments": 4, "rules": "ours"}, ("defaults", "chosen"))])

    def test_a_mark_is_no_point_of_the_grid_if_the_program_has_other_options_for_it(self):
        self.executable("build/apps/trajlo_run", "#!/bin/sh\necho 'window: {segments: 4}'\n"
                        "case \"$*\" in *segments=4*) echo 'tuned: false' ;; esac\n")
        points = self.points(SMALL.replace("[3, 5]", "[3, 4]").replace("none, huber", "none"))
        self.assertIn(((), {"window.segments": "4", "expert.registration.kernel": "none"}),
                      [(point.marks, point.options) for point in points])
        self.assertIn((("defaults",), {}), [(point.marks, point.options) for point in points])

    def test_a_mark_with_the_default_of_a_parameter_is_no_recording_of_its_own(self):
        self.executable("build/apps/trajlo_simulate",
                        "#!/bin/sh\necho motion.speed_mps=3\necho lidar0.channels=16\n")
        text = SMALL.replace("window.segments", "simulate.motion.speed_mps").replace(
            "expert.registration.kernel: [none, huber]", "a.b: {settings: {ours: {}}}").replace(
            "expert.registration.kernel: none", "a.b: ours")
        points = self.points(text)
        self.assertEqual([point.marks for point in points], [("defaults",), ("chosen",)])

    def test_an_option_that_a_mark_states_stands_above_that_of_a_factor_or_of_the_centre(self):
        grid = ONE_AT_A_TIME.replace("one_at_a_time", "grid").replace("{window.segments: 5, ",
                                                                    "{rules: other, ")
        chosen = self.points(grid)[-1]
        self.assertEqual((chosen.marks, chosen.options), (("chosen",), {"a.b": "2"}))
        center = self.points(ONE_AT_A_TIME + "center: {rules: other}\n")[-1]
        self.assertEqual((center.marks, center.options),
                         (("chosen",), {"window.segments": "5", "a.b": "2"}))

    def test_one_at_a_time_takes_what_the_program_shows_as_the_centre(self):
        points = self.points(ONE_AT_A_TIME)
        self.assertEqual([(point.levels, point.marks) for point in points], [
            ({"rules": "ours"}, ("center", "defaults")),
            ({"rules": "ours", "window.segments": 3}, ()),
            ({"rules": "ours", "window.segments": 5}, ()),
            ({"rules": "other"}, ()),
            ({"rules": "ours", "window.segments": 5}, ("chosen",))])
        self.assertEqual(points[-1].options, {"window.segments": "5", "a.b": "2"})

    def test_each_value_of_a_scenario_has_a_recording_that_its_runs_share(self):
        batch = self.batch(SMALL.replace("window.segments", "simulate.motion.speed_mps"))
        self.assertEqual(len({run.sequence.name for run in batch.runs}), 2 + 2 * 2)
        self.assertEqual({run.sequence.parameters.get("motion.speed_mps") for run in batch.runs},
                         {None, "3", "5"})
        self.assertEqual({run.sequence.group for run in batch.runs}, {"hall_os1_16"})

    def test_values_that_are_added_leave_what_is_done_as_it_is(self):
        self.finish(self.batch(SMALL), lambda *_: 0.1)
        states = [run.state for run in self.batch(SMALL.replace("[3, 5]", "[3, 4, 5]")).runs]
        self.assertEqual((states.count("done"), states.count("missing")), (10, 4))

    def test_a_sampled_design_is_taken_from_its_file_while_it_is_the_same(self):
        text = SMALL.replace("{kind: grid}", "{kind: random, samples: 3}").replace(
            "[3, 5]", "{from: 2, to: 9}")
        self.finish(self.batch(text), lambda *_: 0.1)
        path = self.places.output / "design.json"
        saved = json.loads(path.read_text())
        saved["levels"][0]["window.segments"] = 7.5
        path.write_text(json.dumps(saved))
        self.assertEqual(self.points(text)[0].levels["window.segments"], 7.5)
        other = self.points(text.replace("samples: 3", "samples: 3, seed: 2"))
        self.assertNotEqual(other[0].levels["window.segments"], 7.5)


class TerminalTest(PretendedTest):
    def test_the_list_and_the_progress_say_what_a_run_sets(self):
        batch = self.batch(SMALL)
        said = f"{batch.runs[5].folder} (segments = 5, kernel = none, \"chosen\")"
        shown = io.StringIO()
        with contextlib.redirect_stdout(shown):
            command_line.show_list(batch)
        self.assertIn(f"   6 missing  {said}\n", shown.getvalue())
        self.finish(batch, lambda *_: 0.1)
        ended, complete = workflow.Watch(batch).look()
        self.assertEqual((len(ended), complete), (10, 10))
        self.assertEqual(ended[said].result, "ok")

    def test_the_page_says_how_to_repeat_a_row_from_where_it_was_called(self):
        self.pretend_build()
        self.write("own/e.yaml", SMALL)
        command = [SCRIPTS / "experiment", "own/e.yaml", "--build", self.places.build,
                   "--output", self.places.output, "--report"]
        subprocess.run(command, capture_output=True, check=False, cwd=self.folder)
        page = (self.places.output / "report.html").read_text()
        said = re.search("<code>scripts/(experiment .*) --command ROW</code>", page).group(1)
        self.assertTrue(said.startswith("experiment own/e.yaml "), said)
        done = subprocess.run([*f"{SCRIPTS}/{said}".split(), "--command", "1"], text=True,
                              capture_output=True, check=False, cwd=self.folder)
        self.assertEqual(done.stderr, "experiment: row 1 was not run yet\n")

    def test_an_experiment_of_the_same_name_from_another_folder_replaces_nothing(self):
        self.finish(self.batch(SMALL), lambda *_: 0.1)
        other = self.write("own/e.yaml", SMALL.replace("[3, 5]", "[5, 7]"))
        done = subprocess.run([SCRIPTS / "experiment", other, "--build", self.places.build,
                               "--output", self.places.output, "--report"],
                              capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (1, (
            f"experiment: {self.places.output} holds the runs of {self.folder}/e.yaml, and not of "
            f"{other}; name another folder with --output, or give the file another name\n")))

    def test_an_experiment_of_the_project_is_called_by_its_name(self):
        file = ROOT / "config" / "experiments" / "weights.yaml"
        self.assertEqual(
            command_line.call_of("experiment", "experiments", file,
                                 command_line.default_places("weights")),
            "scripts/experiment weights")

    def test_a_sweep_of_densities_that_tune_themselves_is_warned_of_before_the_first_run(self):
        self.executable("build/apps/trajlo_run", "#!/bin/sh\n"
                        "echo 'motion_prior: {self_tuning: true}'\n")
        text = SMALL.replace("window.segments", "expert.motion_prior.translation_m2_s3")
        done = subprocess.run(
            [SCRIPTS / "experiment", self.write("e.yaml", text), "--build", self.places.build,
             "--output", self.places.output, "--list"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("Warning: This is a sweep of expert.motion_prior.translation_m2_s3 while", done.stderr)


if __name__ == "__main__":
    unittest.main()
