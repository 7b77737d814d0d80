# SPDX-License-Identifier: MIT
"""A campaign goes on where it was interrupted, and its report holds every run."""
import contextlib
import csv
import importlib.machinery
import importlib.util
import io
import unittest
import unittest.mock

import numpy as np
from support import SCRIPTS, FolderTest

from trajlo_batch.yaml_lines import SuiteError
from trajlo_campaign import campaign, judge, report


def make_row(number, verdict=judge.WELL, **values):
    return {"run": number, "scene": "hall", "format": "pcd", "faults": "cut + flips",
            "verdict": verdict, "reason": "", "exit_code": 0, "error_m": 0.1 * number,
            "poses_wrong": 0, "first_wrong_s": None, "what": "<b>", **values}


class ReportTest(FolderTest):
    def test_shares_add_up_and_the_page_holds_all_it_shows(self):
        rows = [make_row(k, verdict) for k, verdict in enumerate(judge.VERDICTS)]
        report.write(self.folder, dict(enumerate(rows)), seed=1, version="trajlo_run")
        self.assert_self_contained(self.folder / "report.html")
        self.assertEqual(sum(count for _, count, _, _ in report.shares(rows)), len(rows))
        self.assertIn("10.0 %", (self.folder / "summary.txt").read_text())
        self.assertNotIn("<b>", (self.folder / "report.html").read_text())
        self.assertEqual(len((self.folder / "results.csv").read_text().splitlines()), len(rows) + 1)

    def test_what_is_read_again_makes_the_same_table_and_page(self):
        rows = {7: make_row(7, judge.LOST), 12: make_row(12, judge.UNBOUNDED, error_m=np.inf),
                3: make_row(3, judge.SILENT, poses_wrong=2, first_wrong_s=1.25)}
        found = []
        for _ in range(2):
            report.write(self.folder, rows, 1, "a (b)")
            found.append([(self.folder / name).read_text()
                          for name in ("results.csv", "summary.txt", "report.html")])
            rows = report.read_rows(self.folder, 1, "a (b)")
        self.assertEqual(*found)


def load_script(name):
    """A script without .py, as a module."""
    loader = importlib.machinery.SourceFileLoader(name, str(SCRIPTS / name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
    loader.exec_module(module)
    return module


class GoOnTest(FolderTest):
    """Campaigns whose runs are only pretended; `self.made` holds their numbers."""

    def setUp(self):
        super().setUp()
        self.script, self.build = load_script("fault_campaign"), self.pretend_build()

    def campaign(self, *arguments, until=None, verdict=judge.WELL):
        self.made = []

        def pretend(_, number):
            if number == until:
                raise KeyboardInterrupt
            self.made.append(number)
            return make_row(number, verdict)

        parsed = self.script.make_parser().parse_args(
            [*arguments, f"--build={self.build}", f"--output={self.folder / 'output'}"])
        with unittest.mock.patch.object(campaign.Campaign, "run", pretend), \
                contextlib.redirect_stdout(io.StringIO()):
            return self.script.run(parsed)

    def runs(self):
        with (self.folder / "output" / "results.csv").open() as file:
            return [int(row["run"]) for row in csv.DictReader(file)]

    def test_the_same_command_goes_on_where_one_was_interrupted(self):
        with self.assertRaises(KeyboardInterrupt):
            self.campaign("--runs=5", until=2)
        self.assertEqual(self.runs(), [0, 1])
        self.campaign("--runs=5")
        self.assertEqual((self.made, self.runs()), ([2, 3, 4], [0, 1, 2, 3, 4]))

    def test_runs_before_and_behind_those_that_are_there_are_added(self):
        self.campaign("--first=3", "--runs=2")
        self.campaign("--first=1", "--runs=6")
        self.assertEqual((self.made, self.runs()), ([1, 2, 5, 6], [1, 2, 3, 4, 5, 6]))

    def test_a_run_that_is_named_is_made_again_and_takes_its_place(self):
        self.assertEqual(self.campaign("--runs=3", verdict=judge.SILENT), 3)
        for number in range(3):
            self.assertEqual(self.campaign(f"--only={number}"), 0 if number == 2 else 3)
            self.assertEqual((self.made, self.runs()), ([number], [0, 1, 2]))

    def test_another_seed_or_program_does_not_mix_with_what_is_there(self):
        self.campaign("--runs=2")
        before = (self.folder / "output" / "results.csv").read_text()
        with self.assertRaisesRegex(SuiteError, "seed 1, and this campaign of 2; name another"):
            self.campaign("--runs=3", "--seed=2")
        self.pretend_build("second")
        with self.assertRaisesRegex(SuiteError, "version .*first.*, and this campaign of .*second"):
            self.campaign("--runs=3")
        self.assertEqual((self.folder / "output" / "results.csv").read_text(), before)


class KeepTest(FolderTest):
    def test_a_run_that_is_well_now_leaves_nothing_of_when_it_was_not(self):
        work = campaign.Campaign(None, 1, None, self.folder, self.folder / "kept")
        for verdict in (judge.CRASH, judge.WELL):
            self.write("00003/log.txt", "what it said")
            work.keep(self.folder / "00003", judge.Verdict(verdict), {"run": 3}, ["trajlo_run"])
            self.assertEqual((self.folder / "kept" / "00003").exists(), verdict == judge.CRASH)


if __name__ == "__main__":
    unittest.main()
