# SPDX-License-Identifier: MIT
"""Suites are read strictly, and those of the project are well-formed."""
import os
import unittest

from support import ROOT, FolderTest

from trajlo_batch import suite_files
from trajlo_batch.published import published_of
from trajlo_batch.suite import read_suite
from trajlo_batch.yaml_lines import SuiteError

SMALL = """
sequences:
  - simulate: hall_os1_16
    seeds: [1, 2]
    set: {window.segments: 3}
configurations:
  - name: plain
"""


class SuiteTest(FolderTest):
    def read(self, text):
        return read_suite(self.write("small.yaml", text))

    def refuse(self, text, *parts):
        with self.assertRaises(SuiteError) as caught:
            self.read(text)
        for part in parts:
            self.assertIn(part, str(caught.exception))

    def test_each_seed_is_a_sequence_of_the_same_group(self):
        suite = self.read(SMALL)
        self.assertEqual([(item.name, item.group, item.seed) for item in suite.sequences],
                         [("hall_os1_16-seed1", "hall_os1_16", 1),
                          ("hall_os1_16-seed2", "hall_os1_16", 2)])

    def test_a_sequence_overrides_the_defaults(self):
        suite = self.read("defaults: {set: {window.segments: 4, threads: 1}}\n" + SMALL)
        self.assertEqual(suite.sequences[0].settings, {"window.segments": "3", "threads": "1"})

    def test_settings_are_written_as_options_are(self):
        suite = self.read(SMALL + "    set: {a.b: true, c.d: 0.01, e.f: none}\n")
        self.assertEqual(suite.configurations[0].settings,
                         {"a.b": "true", "c.d": "0.01", "e.f": "none"})

    def test_the_name_of_a_sequence_is_filled_into_its_files(self):
        suite = self.read("defaults: {recording: 'kitti/{name}', truth: 'poses/{name}.txt'}\n"
                          "sequences:\n  - name: \"00\"\nconfigurations:\n  - name: plain\n")
        self.assertEqual(suite.sequences[0].recording, ("kitti/00",))
        self.assertEqual(suite.sequences[0].truth, "poses/00.txt")

    def test_the_name_of_a_sequence_is_filled_into_its_topics(self):
        suite = self.read("defaults: {topics: ['/{name}/points']}\nsequences:\n"
                          "  - {name: front, recording: a.bag}\nconfigurations:\n  - name: plain\n")
        self.assertEqual(suite.sequences[0].topics, ("/front/points",))

    def test_keys_without_effect_are_refused(self):
        end = "configurations:\n  - name: plain\n"
        for key in ("seeds: [1, 2]", "duration_s: 3", "parameters: {a.b: 1}"):
            self.refuse(f"sequences:\n  - name: a\n    recording: a.bag\n    {key}\n{end}",
                        "small.yaml:4", "is not simulated", key.partition(":")[0])
        self.refuse(f"sequences:\n  - name: a\n    recording: a.bag\n    duration_s: 3\n{end}",
                    "set input.duration_s")
        for key in ("recording: a.bag", "truth: a.tum", "topics: [/a]"):
            self.refuse(f"sequences:\n  - simulate: hall_os1_16\n    {key}\n{end}",
                        "small.yaml:3", "is simulated", key.partition(":")[0])
        # Defaults are for sequences of both kinds.
        self.read("defaults: {seeds: [1, 2], truth: '{name}.tum'}\nsequences:\n"
                  f"  - simulate: hall_os1_16\n  - {{name: a, recording: a.bag}}\n{end}")

    def test_folders_of_the_batch_are_no_names(self):
        for name in ("recordings", "truth", "replaced", "slurm"):
            self.refuse(f"sequences:\n  - simulate: hall_os1_16\nconfigurations:\n  - name: {name}\n",
                        f"the batch has a folder {name} of its own")

    def test_a_configuration_can_be_for_some_sequences_only(self):
        suite = self.read(SMALL.replace("    seeds", "  - simulate: hall_os1_16x2\n    seeds")
                          + "    only: '*x2'\n")
        plain = suite.configurations[0]
        self.assertEqual([item.name for item in suite.sequences if plain.takes(item)],
                         ["hall_os1_16x2-seed1", "hall_os1_16x2-seed2"])

    def test_what_is_no_text_is_refused_with_a_sentence(self):
        for name, content in (("bytes.yaml", b"\xff\xfe\x00\x01"), ("control.yaml", b"a: \x00\x01"),
                              ("program.yaml", b"\x7fELF\x02\x01\x01")):
            path = self.folder / name
            path.write_bytes(content)
            with self.assertRaises(SuiteError) as caught:
                read_suite(path)
            self.assertIn(name, str(caught.exception))
        os.mkfifo(self.folder / "pipe.yaml")
        for path in (self.folder / "pipe.yaml", self.folder, "/dev/zero"):
            with self.assertRaises(SuiteError) as caught:
                read_suite(path)
            self.assertIn("is not a file", str(caught.exception))

    def test_an_unknown_key_names_its_line_and_the_nearest_key(self):
        self.refuse(SMALL.replace("seeds", "seed"), "small.yaml:4", "seed", "mean seeds?")

    def test_a_wrong_type_is_refused(self):
        self.refuse("threads: many\n" + SMALL, "small.yaml:1", "threads", "a whole number")
        self.refuse("threads: true\n" + SMALL, "small.yaml:1", "a whole number")

    def test_a_name_that_yaml_takes_for_a_number_is_refused(self):
        self.refuse("sequences:\n  - name: 00\n    recording: a\nconfigurations:\n  - name: b\n",
                    "small.yaml:2", "name must be a text")

    def test_names_cannot_leave_the_folder_of_the_batch(self):
        self.refuse(SMALL.replace("plain", "../plain"), "small.yaml:7", "name of a folder")

    def test_a_pattern_that_matches_nothing_is_refused(self):
        self.refuse(SMALL + "    only: '*x2'\n", "plain", "matches no sequence")

    def test_a_configuration_that_stands_there_twice_is_refused(self):
        self.refuse(SMALL + "  - name: plain\n", "plain", "appears twice")

    def test_a_key_that_stands_there_twice_is_refused(self):
        self.refuse(SMALL + "configurations: []\n", "small.yaml:8", "appears twice")

    def test_merge_keys_are_refused_in_words(self):
        self.refuse("a: &a {b: 1}\nc: {<<: *a}\n", "small.yaml:2", "merge keys")

    def test_a_seed_of_zero_is_refused_because_the_simulator_reads_it_as_none(self):
        self.refuse(SMALL.replace("[1, 2]", "[0]"), "seed", "from 1 on")

    def test_the_suites_of_the_project_are_well_formed(self):
        suites = sorted((ROOT / "config" / "suites").glob("*.yaml"))
        self.assertGreaterEqual(len(suites), 6)
        for path in suites:
            with self.subTest(path.name):
                suite = read_suite(path)
                published_of(suite)
                for file in (file for item in (*suite.sequences, *suite.configurations)
                             for file in item.config if "{data}" not in file):
                    self.assertTrue(suite_files.find(path, file).is_file(), file)

    def test_the_simulation_suite_has_a_dozen_scenarios_with_three_seeds(self):
        suite = read_suite(ROOT / "config" / "suites" / "simulation.yaml")
        groups = {item.group for item in suite.sequences}
        self.assertGreaterEqual(len(groups), 12)
        self.assertEqual(len(suite.sequences), 3 * len(groups))
        self.assertTrue(any(item.degenerate for item in suite.sequences))

    def test_no_scenario_confirms_what_was_chosen_on_it(self):
        choose, confirm = (read_suite(ROOT / "config" / "suites" / f"{name}.yaml")
                           for name in ("choose", "confirm"))
        chosen, confirming = ({item.scenario for item in suite.sequences}
                              for suite in (choose, confirm))
        self.assertFalse(chosen & confirming)
        self.assertLessEqual(abs(len(chosen) - len(confirming)), 1)
        for suite, scenarios in ((choose, chosen), (confirm, confirming)):
            self.assertEqual(len(suite.sequences), 3 * len(scenarios))
        # Kinds that both halves must know, by what their names begin with.
        for kind in ("hall", "square", "facade", "long_facade", "atrium", "tall_room", "office",
                     "corridor", "stairwell", "forest", "bursts", "spin", "swing", "street",
                     "motorway", "manhattan", "faults"):
            for scenarios in (chosen, confirming):
                self.assertTrue(any(name.startswith(kind) for name in scenarios), kind)


class NamedFileTest(FolderTest):
    def test_a_file_of_the_project_has_a_short_name(self):
        for word, kind in (("simulation", "suites"), ("simulation.yaml", "suites"),
                           ("weights", "experiments")):
            self.assertEqual(suite_files.of_project(word, kind),
                             ROOT / "config" / kind / f"{word.removesuffix('.yaml')}.yaml")

    def test_a_file_comes_before_a_name_and_a_folder_does_not(self):
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)
        (self.folder / "simulation").mkdir()
        named = ROOT / "config" / "suites" / "simulation.yaml"
        self.assertEqual(suite_files.of_project("simulation", "suites"), named)
        self.write("simulation.yaml", SMALL)
        self.assertEqual(str(suite_files.of_project("simulation.yaml", "suites")),
                         "simulation.yaml")

    def test_a_misspelt_name_has_a_suggestion(self):
        other = self.write("flights.yaml", SMALL)
        for word, said in (
                ("simulatoin", "no suite of this name; did you mean simulation?"),
                ("nothing_like_it", "there are ablation, choose, "),
                ("config/suites/simulatoin.yaml", f"did you mean {ROOT}/config/suites/simulation"),
                (str(self.folder / "fligths.yaml"), f"did you mean {other}?")):
            with self.assertRaises(SuiteError) as caught:
                suite_files.of_project(word, "suites")
            self.assertIn(said, str(caught.exception))


if __name__ == "__main__":
    unittest.main()
