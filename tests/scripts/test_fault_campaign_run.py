# SPDX-License-Identifier: MIT
"""A slice of the fault campaign, and a short soak, with the programs of the build."""
import csv
import json
import os
import pathlib
import subprocess
import unittest

from support import ROOT, SCRIPTS, FolderTest, built

from trajlo_campaign import campaign, judge, scenes
from trajlo_campaign.draw import Drawn

RUNS = 24
# Of that many runs; each is a defect that scripts/fault_campaign shows.
MOST_WRONG_IN_SILENCE = 4


class BuiltTest(FolderTest):
    def setUp(self):
        super().setUp()
        self.programs = campaign.Programs(built("trajlo_run"), built("trajlo_simulate"))
        self.build = pathlib.Path(os.environ.get("TRAJLO_BUILD_DIR", ROOT / "build"))

    def script(self, name, *arguments):
        return subprocess.run([SCRIPTS / name, *arguments, "--build", self.build, "--output",
                               self.folder / "output"], capture_output=True, text=True, check=False)

    def rows(self):
        with (self.folder / "output" / "results.csv").open() as file:
            return list(csv.DictReader(file))


class CampaignRunTest(BuiltTest):
    def test_without_faults_every_scene_ends_well(self):
        bases = campaign.Bases(self.programs, self.folder / "bases")
        work = campaign.Campaign(self.programs, 1, bases, self.folder, self.folder / "kept")
        for number, scene in enumerate(scenes.SCENES):
            for kind in {"pcd", scene.formats[-1]}:
                with self.subTest(scene=scene.name, format=kind):
                    row = work.run_drawn(Drawn(number, scene, kind, ()))
                    # At its turning points the swing sees bare floor for a quarter of a second.
                    # Whether it comes out of that well is chance, but it never does so unflagged;
                    # and where the recording ends before its place is found again, it is lost.
                    accepted = {judge.WELL}
                    if scene.name == "swing":
                        accepted |= {judge.FLAGGED, judge.LOST}
                    self.assertIn(row["verdict"], accepted, row["reason"])
                    self.assertGreater(row["covered"], 0.97)

    def test_a_bag_that_is_cut_gives_what_is_before_the_cut_and_three(self):
        bases = campaign.Bases(self.programs, self.folder / "bases")
        bag = bases.get(scenes.SCENES[2], "bag") / "recording.bag"
        os.truncate(bag, bag.stat().st_size * 6 // 10)
        result = self.folder / "result"
        done = subprocess.run([self.programs.run, f"--input={bag}", f"--output={result}"],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertRegex(done.stderr, r"recording\.bag.* bytes lost")
        exit_code = json.loads((result / "run.json").read_text())["exit"]
        self.assertEqual(exit_code["code"], 3)
        self.assertIn("missing or broken", exit_code["message"])
        poses = (result / "trajectory.tum").read_text().splitlines()
        self.assertGreater(float(poses[-1].split()[0]) - float(poses[0].split()[0]), 3.4)

    def test_random_faults_neither_crash_nor_hang_nor_pass_in_silence(self):
        done = self.script("fault_campaign", "--runs", str(RUNS))
        rows = self.rows()
        self.assertEqual(len(rows), RUNS, done.stderr)
        worst = [row for row in rows
                 if row["verdict"] in (judge.CRASH, judge.HANG, judge.UNBOUNDED)]
        self.assertEqual(worst, [])
        silent = [row["run"] for row in rows if row["verdict"] == judge.SILENT]
        self.assertLessEqual(len(silent), MOST_WRONG_IN_SILENCE, silent)
        self.assertEqual(done.returncode, 3 if silent else 0)
        self.assert_self_contained(self.folder / "output" / "report.html")

    def test_a_run_is_the_same_again(self):
        found = []
        for _ in range(2):
            self.script("fault_campaign", "--only", "3", "--keep")
            row, = self.rows()
            found.append({key: value for key, value in row.items()
                          if key not in ("cpu_s", "memory_mb", "message")})
            self.assertTrue((self.folder / "output" / "kept" / "00003" / "recording").is_dir())
        self.assertEqual(*found)


class SoakTest(BuiltTest):
    def test_five_minutes_with_every_kind_of_fault_are_counted(self):
        done = self.script("soak", "--hours", "0.085", "--columns", "128")
        document = json.loads((self.folder / "output" / "soak.json").read_text())
        # So short a run has not seen the whole scene before its second half: memory still grows.
        failed = [check for check in document["checks"]
                  if not check["holds"] and check["what"] != "memory is flat"]
        self.assertEqual(failed, [], done.stdout + done.stderr)
        self.assertGreaterEqual(len(document["faults"]), 15)


if __name__ == "__main__":
    unittest.main()
