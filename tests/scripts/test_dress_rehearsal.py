# SPDX-License-Identifier: MIT
"""From a folder of downloads to the tables of the paper, as a reader does it, on data sets that
only look like the public ones: a wrong axis, stamp or lever arm anywhere makes errors large."""
import csv
import os
import pathlib
import re
import subprocess
import unittest

import lookalikes
from support import ROOT, SCRIPTS, FolderTest, built


class DressRehearsal(FolderTest):
    def setUp(self):
        super().setUp()
        self.simulator = built("trajlo_simulate")
        self.build = pathlib.Path(os.environ.get("TRAJLO_BUILD_DIR", ROOT / "build"))
        for name in ("trajlo_run", "trajlo_evaluate", "trajlo_info", "trajlo_convert"):
            built(name)
        self.downloads, self.data = self.folder / "downloads", self.folder / "data"
        self.downloads.mkdir()

    def call(self, *command):
        done = subprocess.run([*map(str, command), "--build", str(self.build)],
                              capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr

    def lay_out(self, name, missing=True):
        code, text = self.call(SCRIPTS / "datasets" / name, self.downloads, "--into", self.data)
        self.assertEqual(code, 3 if missing else 0, text)
        return text

    def batch(self, name, code=0):
        """What the batch says; its rows and tables are kept."""
        output = self.folder / "out"
        found, text = self.call(SCRIPTS / "batch", ROOT / "config" / "suites" / f"{name}.yaml",
                                "--data", self.data, "--output", output, "-j", 2)
        log = output / "snakemake.log"
        self.assertEqual(found, code, text + (log.read_text() if log.is_file() else ""))
        if code == 0:
            with (output / "results.csv").open() as file:
                self.rows = list(csv.DictReader(file))
            self.assertEqual({row["result"] for row in self.rows} - {"ok", "no truth"}, set())
            self.assert_self_contained(output / "report.html")
            self.page = (output / "report.html").read_text()
        return text

    def table(self, name):
        """A table in Markdown: cells by (approach, column)."""
        lines = (self.folder / "out" / f"{name}.md").read_text().splitlines()
        lines = [[cell.strip() for cell in line.strip("|").split("|")]
                 for line in lines if line.startswith("|")]
        head, body = lines[0], lines[2:]
        label = head.index("approach")
        return {(line[label], column): cell for line in body for column, cell in zip(head, line)}

    def test_kitti(self):
        lookalikes.make_kitti(self.simulator, self.folder, self.downloads, lidar0__columns=512)
        self.assertIn("MISSING kitti/poses/00.txt", self.lay_out("kitti"))
        text = self.batch("kitti")
        self.assertIn(f", 10: no data; looked for {self.data}/kitti/sequences/NAME", text)
        self.assertIn("No data for 10 of 11 sequences", text)
        self.assertIn(f"{self.data}/kitti/poses/00.txt", self.page)

        row, = self.rows
        # Without the correction of the vertical angles it is 0.4 %, with the axes of the camera
        # mixed up a hundred.
        self.assertLess(float(row["kitti_translation_percent"]), 0.1)
        self.assertLess(float(row["ate_rmse_m"]), 0.03)
        self.assertEqual(float(row["completeness"]), 1.0)
        table = self.table("traj_lo_kitti")
        self.assertEqual(table["Traj-LO", "04"], "0.40")
        self.assertEqual(table["KISS-ICP", "04"], "0.35")
        ours = f"{float(row['kitti_translation_percent']):.2f}"
        self.assertEqual(table[r"trajlo \*", "04"], f"**{ours}**")
        self.assertEqual(table[r"trajlo \*", "05"], "-")
        self.assertEqual(table[r"trajlo \*", "AVG"], f"{ours} (1 of 11)")
        self.assertEqual(table["Traj-LO", "Online"], "**0.58**")

    def test_ntu_viral(self):
        lookalikes.make_ntu_viral(self.simulator, self.folder, self.downloads, "eee_01")
        lookalikes.make_ntu_viral(self.simulator, self.folder, self.downloads, "spms_02", seed=2)
        text = self.lay_out("ntu_viral")
        self.assertIn("ok      ntu_viral/spms_02/spms_02.bag", text)
        self.assertTrue((self.data / "ntu_viral" / "eee_01" / "truth.tum").is_file())
        self.assertIn("No data for 16 of 18 sequences", self.batch("ntu_viral"))

        self.assertEqual(len(self.rows), 4)
        for row in self.rows:
            # evo's pairs are up to 10 ms apart, at 3 m/s.
            self.assertLess(float(row["ate_rmse_m"]), 0.02, row["folder"])
            self.assertEqual(float(row["completeness"]), 1.0)
        table = self.table("traj_lo_ntu_viral")
        self.assertEqual(table["FAST-LIO (L1+I)", "eee_01"], "<u>0.029</u>")
        self.assertEqual(table["Traj-LO (L1)", "spms_02"], "×")
        self.assertEqual(table["Traj-LO (L1+L2)", "spms_02"], "0.163")
        best = min(float(row["ate_rmse_m"]) for row in self.rows if row["sequence"] == "spms_02")
        self.assertIn(f"**<u>{best:.3f}</u>**", (table[r"trajlo \* (L1)", "spms_02"],
                                                table[r"trajlo \* (L1+L2)", "spms_02"]))
        self.assertEqual({label for label, _ in self.table("table")},
                         {"trajlo (L1)", "trajlo (L1+L2)"})
        latex = (self.folder / "out" / "traj_lo_ntu_viral.tex").read_text()
        self.assertIn(rf"\textbf{{\underline{{{best:.3f}}}}}", latex)
        self.assertIn(r"$\times$", latex)

        statuses = {path: path.stat().st_mtime_ns
                    for path in (self.folder / "out").glob("*/*/status.json")}
        self.batch("ntu_viral")
        for path, changed in statuses.items():
            self.assertEqual(path.stat().st_mtime_ns, changed, "a run was done twice")

    def test_hilti2021(self):
        for name, kind in (("LAB_Survey_2", "imu"), ("Basement_4", "prism")):
            lookalikes.make_hilti2021(self.simulator, self.folder, self.downloads, name, kind)
        self.assertIn("hilti2021/calibration_02.yaml <-", self.lay_out("hilti2021"))
        self.assertIn("No data for 4 of 6 sequences", self.batch("hilti2021"))
        self.assertEqual(len(self.rows), 6)
        for row in self.rows:
            self.assertLess(float(row["ate_rmse_m"]), 0.03, row["folder"])
        table = self.table("traj_lo_hilti2021")
        self.assertEqual(table["Traj-LO (L1+L2)", "Base4"], "0.049")
        self.assertIn("<u>", table[r"trajlo \* (L1)", "Lab"] + table[r"trajlo \* (L1+L2)", "Lab"])

    def test_pointlio(self):
        lookalikes.make_pointlio(self.simulator, self.folder, self.downloads, duration_s=2)
        self.lay_out("pointlio", missing=False)
        self.batch("pointlio")
        self.assertEqual({row["sequence"]: row["result"] for row in self.rows},
                         {"indoor_swing": "no truth", "outdoor_spin": "no truth"})
        for row in self.rows:
            self.assertLess(float(row["distance_to_start_m"]), 3)
            value = f"{float(row['distance_to_start_m']):.4f}"
            # Below the little picture, and in the table; not the page of it all in the message.
            self.assertTrue(re.search(rf"trajlo:\s+{re.escape(value)}", self.page), value)

    def test_without_data_a_suite_says_what_it_looked_for_and_where_to_get_it(self):
        for name, file in (("kitti", "kitti/poses/NAME.txt"), ("hilti2021", "hilti2021/rig.yaml"),
                           ("ntu_viral", "ntu_viral/NAME/NAME.bag"),
                           ("pointlio", "pointlio/NAME.bag")):
            text = self.batch(name, code=2)
            self.assertIn(str(self.data / file), text)
            self.assertIn(f"scripts/datasets/{name} --help", text)
            self.assertLess(len(text.splitlines()), 9)


if __name__ == "__main__":
    unittest.main()
