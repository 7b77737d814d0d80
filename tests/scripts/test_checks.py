# SPDX-License-Identifier: MIT
"""What the programs would refuse, and files that are not there, end a batch before its first run."""
import os
import unittest
from unittest import mock

from support import ROOT, FolderTest

from trajlo_batch import plan, suite_files
from trajlo_batch.places import Places
from trajlo_batch.published import published_of
from trajlo_batch.suite import read_suite
from trajlo_batch.yaml_lines import SuiteError
from trajlo_experiment.experiment import read_experiment
from trajlo_experiment.points import make_study

SUITE = """
sequences:
  - simulate: hall_os1_16
  - {name: away, recording: nowhere.bag, topics: [/a]}
configurations:
  - name: plain
"""
# Refuses as the real one does: unknown flags first, files that are not there with another code.
PRETENDED = """#!/bin/sh
for argument in "$@"; do
  case "$argument" in
    *wrong*) echo "NAME: unknown $argument; did you mean right?" >&2
             echo "(NAME --help shows examples)" >&2; exit 1 ;;
    estimate) code=2 ;;
    --list_parameters) echo lidar0.channels=16; echo lidar1.channels=16 ;;
    --show_config) echo "window: {segments: 4}" ;;
  esac
done
exit ${code:-0}
"""


class ChecksTest(FolderTest):
    def setUp(self):
        super().setUp()
        for name in ("trajlo_run", "trajlo_simulate", "trajlo_evaluate"):
            self.executable(f"build/apps/{name}", PRETENDED.replace("NAME", name))
        self.places = Places(self.folder / "build", self.folder / "data", self.folder / "out")

    def plan(self, text):
        return plan.make_plan(read_suite(self.write("s.yaml", text)), self.places)

    def refuse(self, text, message):
        with self.assertRaisesRegex(SuiteError, rf"s\.yaml: {message}") as caught:
            self.plan(text)
        self.assertNotIn("--help", str(caught.exception))

    def test_a_good_suite_is_planned(self):
        self.assertEqual([run.folder for run in self.plan(SUITE).runs],
                         ["plain/hall_os1_16-seed1"])

    def test_a_scenario_or_a_parameter_that_is_none_is_named(self):
        self.refuse(SUITE.replace("hall_os1_16", "wrong_os1"),
                    "the sequence wrong_os1-seed1 is refused: trajlo_simulate: unknown .*mean right")
        self.refuse(SUITE.replace("hall_os1_16", "hall_os1_16\n    parameters: {wrong.a: 1}"),
                    "the sequence hall_os1_16-seed1 is refused")

    def test_flags_are_checked(self):
        for key, program in (("run", "trajlo_run"), ("evaluate", "trajlo_evaluate")):
            self.refuse(SUITE.replace("hall_os1_16", f"hall_os1_16\n    {key}: {{wrong: 1}}"),
                        f".*hall_os1_16-seed1 is refused: {program}: unknown --wrong=1")

    def test_what_has_no_data_is_checked_as_well(self):
        for key in ("run", "evaluate", "set"):
            self.refuse(SUITE.replace("[/a]", f"[/a], {key}: {{wrong: 1}}"), ".*away is refused")

    def test_a_configuration_that_comes_with_missing_data_is_no_mistake(self):
        text = SUITE.replace("[/a]", "[/a], config: '{data}/rig.yaml'")
        self.assertIn(str(self.folder / "data/rig.yaml"), self.plan(text).missing["away"])

    def test_lidars_that_no_sequence_has_are_named(self):
        self.refuse(SUITE + "    lidars: [2]\n",
                    "the configuration plain asks for LiDAR 2.* hall_os1_16-seed1 has 2")
        self.refuse(SUITE + "    lidars: [1]\n", ".*LiDAR 1.* away has 1")

    def test_the_scenarios_of_an_experiment_are_checked(self):
        study = make_study(read_experiment(self.write("s.yaml", "design: {kind: grid}\nvary:\n"
                           "  window.segments: [2, 3]\nsequences:\n  - simulate: wrong\n")),
                           self.places)
        with self.assertRaisesRegex(SuiteError, "s.yaml: the sequence wrong-seed1 is refused"):
            plan.make_plan(study, self.places)


class SuiteFilesTest(FolderTest):
    def find(self, word, **environment):
        with mock.patch.dict(os.environ, environment):
            return suite_files.find(self.folder / "s.yaml", word, suite_files.named_configs())

    def refuse(self, word, message):
        with self.assertRaisesRegex(SuiteError, message):
            self.find(word)

    def test_a_relative_path_is_below_the_suites_folder_or_else_the_projects(self):
        own = self.write("mine/own.yaml", "")
        self.assertEqual(self.find("mine/own.yaml"), own)
        self.assertEqual(self.find("config/datasets/ouster.yaml"),
                         ROOT / "config/datasets/ouster.yaml")
        own = self.write("config/datasets/ouster.yaml", "")
        self.assertEqual(self.find("config/datasets/ouster.yaml"), own)

    def test_a_name_is_that_of_a_configuration(self):
        self.write("ouster", "")
        self.assertEqual(self.find("ouster"), ROOT / "config/datasets/ouster.yaml")
        self.assertEqual(self.find("indoor"), ROOT / "config/indoor.yaml")
        other = self.write("named/mine.yaml", "")
        self.assertEqual(self.find("mine", TRAJLO_CONFIG_DIR=str(other.parent)), other)

    def test_variables_are_filled_in(self):
        own = self.write("there/a.yaml", "")
        self.assertEqual(self.find("$HERE/a.yaml", HERE=str(own.parent)), own)

    def test_what_is_not_there_is_named_with_the_places_and_the_nearest_name(self):
        self.refuse("oster", "s.yaml: there is no configuration oster; did you mean ouster?")
        self.refuse("mine/oster.yaml", f"there is no {self.folder}/mine/oster.yaml, nor "
                                       f"{ROOT}/mine/oster.yaml; did you mean ouster?")
        self.write("mine/austere.yaml", "")
        self.refuse("mine/oustere.yaml", "did you mean austere.yaml?")
        self.refuse("/no/a.yaml", "there is no /no/a.yaml$")
        self.write("c.yaml", "")  # Of the same ending, and of another name.
        self.refuse("x.yaml", "/x.yaml$")

    def test_published_tables_are_found_in_the_same_way(self):
        suite = read_suite(self.write("s.yaml", SUITE + "published: mine.yaml\n"))
        with self.assertRaisesRegex(SuiteError, f"there is no {self.folder}/mine.yaml"):
            published_of(suite)
        self.write("mine.yaml", "rows: 1\n")
        with self.assertRaisesRegex(SuiteError, "rows must be a list"):
            published_of(suite)


PUBLISHED = """
source: a paper
caption: errors
metric: {metric}
unit: "{unit}"
decimals: 2
columns: [hall]
rows:
  - {{approach: theirs, category: LO, values: ["0.75"]}}
"""


class PublishedTest(FolderTest):
    def compare(self, metric, unit, name="paper.yaml", ours="ate_rmse_m"):
        self.write(name, PUBLISHED.format(metric=metric, unit=unit))
        return published_of(read_suite(self.write(
            "s.yaml", SUITE + f"metric: {ours}\npublished: {name}\n")))

    def test_numbers_of_another_kind_or_unit_are_not_compared(self):
        self.assertEqual(self.compare("ate_rmse_m", "m")[0][0], "paper")
        self.compare("kitti_translation_percent", "%", ours="kitti_translation_percent")
        self.compare("kitti_rotation_deg_per_m", "°/m", ours="kitti_rotation_deg_per_m")
        with self.assertRaisesRegex(SuiteError, "give the suite the metric kitti_translation"):
            self.compare("kitti_translation_percent", "%")
        with self.assertRaisesRegex(SuiteError, "are in cm, and ours of ate_rmse_m are in m"):
            self.compare("ate_rmse_m", "cm")

    def test_the_batchs_own_tables_are_not_overwritten(self):
        for name in ("speed.yaml", "table.yaml"):
            with self.assertRaisesRegex(SuiteError, "of its own; give this file another name"):
                self.compare("ate_rmse_m", "m", name)


class LocatedTest(FolderTest):
    """Files that options and flags name."""

    def setUp(self):
        super().setUp()
        self.places = Places(self.folder, self.folder / "data", self.folder / "out")
        self.suite = read_suite(self.write("s/s.yaml", SUITE))

    def located(self, **values):
        return suite_files.located(self.places, self.suite,
                                   {key.replace("__", "."): value for key, value in values.items()})

    def test_they_are_found_beside_the_suite(self):
        stamps = self.write("s/stamps.txt", "1\n")
        self.assertEqual(self.located(input__stamps_file="stamps.txt", window__segments="3"),
                         {"input.stamps_file": str(stamps), "window.segments": "3"})
        with self.assertRaisesRegex(SuiteError, "there is no .*/s/tims.txt"):
            self.located(times="tims.txt")

    def test_those_of_the_data_are_found_there_and_may_be_missing(self):
        self.assertEqual(self.located(times="{data}/a.txt"),
                         {"times": f"{self.folder}/data/a.txt"})

    def test_configurations_have_names_too(self):
        mine = self.write("s/mine.yaml", "")
        self.assertEqual(self.located(config="ouster,mine.yaml"),
                         {"config": f"{ROOT}/config/datasets/ouster.yaml,{mine}"})

    def test_what_they_say_is_a_part_of_what_a_result_depends_on(self):
        stamps = self.write("s/stamps.txt", "1\n")
        before = suite_files.digests(self.located(input__stamps_file="stamps.txt"))
        stamps.write_text("2\n")
        after = suite_files.digests(self.located(input__stamps_file="stamps.txt"))
        self.assertEqual((len(before), len(after)), (1, 1))
        self.assertNotEqual(before, after)
        self.assertEqual(suite_files.digests({"window.segments": str(stamps), "times": ""}), [])


if __name__ == "__main__":
    unittest.main()
