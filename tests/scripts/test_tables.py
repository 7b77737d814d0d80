# SPDX-License-Identifier: MIT
"""Tables mark the best as the paper does, and say what failed."""
import pathlib
import unittest

from support import ROOT, FolderTest

from trajlo_batch import batch_report, results, table_formats, tables
from trajlo_batch.published import read_published
from trajlo_batch.suite import Configuration, Sequence, Suite
from trajlo_batch.yaml_lines import SuiteError

PUBLISHED = ROOT / "config" / "published"


def make_suite(configurations=("ours",), groups=("eee_01",), **options):
    return Suite(name="s", file=pathlib.Path("s.yaml"), title="A suite", description="", needs="",
                 sequences=tuple(Sequence(name=group, group=group) for group in groups),
                 configurations=tuple(Configuration(name, name, sensors="L1")
                                      for name in configurations),
                 published=(), **options)


def row(configuration, group, value, result="ok", sequence=None):
    return {"configuration": configuration, "group": group, "sequence": sequence or group,
            "ate_rmse_m": value, "kitti_translation_percent": value, "result": result,
            "reason": result, "folder": f"{configuration}/{sequence or group}"}


class PublishedTest(FolderTest):
    def test_the_tables_of_the_paper_are_complete(self):
        sizes = {path.stem: (len(table.rows), len(table.columns)) for path in
                 PUBLISHED.glob("*.yaml") for table in [read_published(path)]}
        self.assertEqual(sizes, {"traj_lo_kitti": (4, 13), "traj_lo_ntu_viral": (10, 18),
                                 "traj_lo_hilti2021": (14, 6)})

    def test_some_printed_values(self):
        def value(file, approach, sensors, column):
            table = read_published(PUBLISHED / f"{file}.yaml")
            values, = (values for name, _, found, values in table.rows
                       if (name, found) == (approach, sensors))
            return values[table.columns.index(column)]

        self.assertEqual(value("traj_lo_kitti", "Traj-LO", "", "Online"), "0.58")
        self.assertEqual(value("traj_lo_ntu_viral", "Traj-LO", "L1", "spms_02"), "x")
        self.assertEqual(value("traj_lo_ntu_viral", "SLICT", "L1+L2+I", "spms_02"), "0.10")
        self.assertEqual(value("traj_lo_hilti2021", "Traj-LO", "L1+L2", "Cons2"), "0.063")
        self.assertEqual(value("traj_lo_hilti2021", "LIO-SAM", "", "RPG"), "-")

    def test_a_row_with_a_value_too_few_is_refused(self):
        text = (PUBLISHED / "traj_lo_hilti2021.yaml").read_text().replace('"2.775", ', "", 1)
        with self.assertRaisesRegex(SuiteError, "6 values are needed"):
            read_published(self.write("short.yaml", text))


class ComparedTableTest(unittest.TestCase):
    def table(self, value, result="ok", columns=("eee_01",)):
        published = read_published(PUBLISHED / "traj_lo_ntu_viral.yaml")
        suite = make_suite(groups=columns)
        return tables.compared_table(suite, [row("ours", columns[0], value, result)], published)

    def cell(self, table, label, sensors, column="eee_01"):
        line, = (line for line in table.lines if (line.label, line.sensors) == (label, sensors))
        return line.cells[table.columns.index(column)]

    def test_without_us_the_best_are_those_of_the_paper(self):
        table = self.table(None, "x")
        self.assertTrue(self.cell(table, "FAST-LIO", "L1+I").best)
        self.assertTrue(self.cell(table, "FAST-LIO", "L1+I").category_best)
        ours = self.cell(table, "Traj-LO", "L1+L2")
        self.assertEqual((ours.best, ours.category_best), (False, True))

    def test_a_better_result_takes_the_marks(self):
        table = self.table(0.0281)
        self.assertEqual(self.cell(table, "ours", "L1").text, "0.028")
        self.assertTrue(self.cell(table, "ours", "L1").best)
        self.assertFalse(self.cell(table, "FAST-LIO", "L1+I").best)
        self.assertTrue(self.cell(table, "FAST-LIO", "L1+I").category_best)
        self.assertFalse(self.cell(table, "Traj-LO", "L1+L2").category_best)

    def test_of_values_that_are_printed_alike_the_better_one_is_the_best(self):
        table = self.table(0.0294)
        self.assertEqual(self.cell(table, "ours", "L1").text, "0.029")
        self.assertFalse(self.cell(table, "ours", "L1").best)
        self.assertTrue(self.cell(table, "FAST-LIO", "L1+I").best)
        table = self.table(0.029)
        self.assertTrue(self.cell(table, "ours", "L1").best)
        self.assertTrue(self.cell(table, "FAST-LIO", "L1+I").best)

    def test_our_rows_stand_in_their_category(self):
        categories = [line.category for line in self.table(1.0).lines]
        self.assertEqual(categories, ["LO"] * 7 + ["LIO"] * 4)

    def test_a_divergence_is_an_x_and_what_was_not_run_a_dash(self):
        table = self.table(None, "x")
        self.assertEqual(self.cell(table, "ours", "L1").text, "x")
        self.assertEqual(self.cell(table, "ours", "L1", "eee_02").text, "-")

    def test_an_average_over_some_of_the_sequences_says_so_and_is_not_the_best(self):
        published = read_published(PUBLISHED / "traj_lo_kitti.yaml")
        suite = make_suite(groups=published.columns[:11], metric="kitti_translation_percent")
        rows = [row("ours", "04", 0.1)]
        cell = tables.compared_table(suite, rows, published).lines[-1].cells[11]
        self.assertEqual((cell.text, cell.best), ("0.10 (1 of 11)", False))
        rows = [row("ours", name, 0.1) for name in published.columns[:11]]
        cell = tables.compared_table(suite, rows, published).lines[-1].cells[11]
        self.assertEqual((cell.text, cell.best), ("0.10", True))

    def test_the_average_leaves_out_what_has_an_x_and_says_so(self):
        published = read_published(PUBLISHED / "traj_lo_kitti.yaml")
        suite = make_suite(groups=("00", "01"), metric="kitti_translation_percent")
        rows = [row("ours", "00", 0.4), row("ours", "01", 0.6)]
        table = tables.compared_table(suite, rows, published)
        self.assertEqual(table.lines[-1].cells[table.columns.index("AVG")].text, "0.50")
        rows[1]["result"] = "x"
        table = tables.compared_table(suite, rows, published)
        self.assertEqual(table.lines[-1].cells[table.columns.index("AVG")].text, "0.40 (1 of 2)")
        # The others' means over the same sequence, which is what ours compares with.
        self.assertEqual(table.notes[-1], "AVG without 01: FLOAM 0.71, KISS-ICP 0.52, CT-ICP 0.49, "
                         "Traj-LO 0.50, ours * (L1) 0.40.")
        rows[0]["result"] = "x"
        table = tables.compared_table(suite, rows, published)
        self.assertEqual(table.lines[-1].cells[table.columns.index("AVG")].text, "-")


class SuiteTableTest(unittest.TestCase):
    def test_seeds_become_their_median(self):
        rows = [row("ours", "eee_01", value, sequence=f"eee_01-seed{i}")
                for i, value in enumerate((0.1, 0.9, 0.2))]
        cell = tables.suite_table(make_suite(), rows).lines[0].cells[0]
        self.assertEqual(cell.text, "0.2000")
        self.assertIn("0.1000 to 0.9000, 3 seeds", cell.note)

    def test_errors_of_millimetres_are_told_apart(self):
        rows = [row("ours", "eee_01", 0.00169), row("theirs", "eee_01", 0.00191)]
        lines = tables.suite_table(make_suite(configurations=("ours", "theirs")), rows).lines
        self.assertEqual([(line.cells[0].text, line.cells[0].best) for line in lines],
                         [("0.0017", True), ("0.0019", False)])

    def test_the_fastest_is_the_best(self):
        suite = make_suite(configurations=("ours", "theirs"), metric="times_real_time")
        rows = [dict(row("ours", "eee_01", 0.1), times_real_time=20.0),
                dict(row("theirs", "eee_01", 0.1), times_real_time=2.0)]
        ours, theirs = (line.cells[0] for line in tables.suite_table(suite, rows).lines)
        self.assertEqual((ours.best, theirs.best), (True, False))

    def test_a_metric_that_no_run_has_is_an_error_with_the_nearest(self):
        for metric in ("ate_rmse_m", "rpe_1m_rmse_m", "cpu_s_per_data_second"):
            results.check_metric(make_suite(metric=metric))
        with self.assertRaisesRegex(SuiteError, "did you mean 'ate_rmse_m'"):
            results.check_metric(make_suite(metric="ate_rms_m"))
        for metric, said in (("ate", "did you mean 'ate_rmse_m'"), ("host", "there are ate_rmse_m"),
                             ("rpe", "did you mean 'rpe_1m_rmse_m'")):
            with self.assertRaisesRegex(SuiteError, said):
                results.check_metric(make_suite(metric=metric))

    def test_a_seed_that_failed_is_counted_and_forfeits_the_mark(self):
        suite = make_suite(configurations=("ours", "theirs"))
        rows = [row("ours", "eee_01", 0.1, sequence="a"),
                row("ours", "eee_01", 0.1, "x", sequence="b"), row("theirs", "eee_01", 0.2)]
        ours, theirs = (line.cells[0] for line in tables.suite_table(suite, rows).lines)
        self.assertEqual((ours.text, ours.best), ("0.1000 (1 x)", False))
        self.assertTrue(theirs.best)

    def test_a_seed_that_has_not_ended_is_counted_and_no_mark_is_given(self):
        suite = make_suite(configurations=("ours", "theirs"))
        rows = [row("ours", "eee_01", 0.1, sequence="a"),
                row("ours", "eee_01", None, "not finished", sequence="b"),
                row("ours", "eee_01", None, "not asked for", sequence="c"),
                row("theirs", "eee_01", 0.2)]
        table = tables.suite_table(suite, rows)
        for text in (table_formats.to_markdown(table), table_formats.to_latex(table),
                     table_formats.to_csv(table)):
            self.assertIn("0.1000 (1 of 3)", text)
        ours, theirs = (line.cells[0] for line in table.lines)
        self.assertEqual((ours.best, theirs.best), (False, True))
        rows[1]["result"] = "x"
        cell = tables.suite_table(suite, rows).lines[0].cells[0]
        self.assertEqual((cell.text, cell.best), ("0.1000 (1 x) (2 of 3)", False))
        rows[0]["result"] = "not finished"
        self.assertEqual(tables.suite_table(suite, rows).lines[0].cells[0].text, "x (1 of 3)")

    def seeded(self, **counts):
        return [dict(row("ours", group, 0.1, sequence=f"{group}-seed{seed}"), seed=seed)
                for group, count in counts.items() for seed in range(1, count + 1)]

    def test_the_footnote_counts_the_seeds_of_a_cell_and_not_those_of_the_suite(self):
        table = tables.suite_table(make_suite(groups=("a", "b")), self.seeded(a=2, b=2))
        self.assertIn("Each value is the median of 2 seeds; (1 x) says that one of them failed, "
                      "(1 of 2) that only one has ended.", table.notes)
        rows = self.seeded(a=2, b=2)
        rows[2]["seed"], rows[3]["seed"] = 3, 4
        self.assertIn("median of 2 seeds;", tables.suite_table(
            make_suite(groups=("a", "b")), rows).notes[0])
        one = tables.suite_table(make_suite(groups=("a", "b")), self.seeded(a=1, b=1))
        self.assertEqual(one.notes, [])

    def test_a_cell_of_fewer_seeds_than_others_says_so(self):
        rows = self.seeded(a=3, b=1, c=2)
        rows[-1]["result"] = "x"
        rows.append(dict(row("ours", "real", 0.1), seed=None))
        table = tables.suite_table(make_suite(groups=("a", "b", "c", "real")), rows)
        self.assertEqual([cell.text for cell in table.lines[0].cells],
                         ["0.1000", "0.1000 (1 seed)", "0.1000 (1 x) (2 seeds)", "0.1000"])
        note, = table.notes
        self.assertIn("median over the seeds of its sequence (1 to 3); cells based on fewer seeds "
                      "say so; real recordings have no seeds; (1 x)", note)

    def test_a_run_whose_input_is_in_doubt_has_a_sign_and_a_note(self):
        suite = make_suite(groups=("a", "b"))
        rows = [dict(row("ours", "a", 0.1), exit_code=3, reason="a scan is damaged"),
                dict(row("ours", "b", 0.1), exit_code=0)]
        table = tables.suite_table(suite, rows)
        self.assertEqual([cell.text for cell in table.lines[0].cells], ["0.1000 !", "0.1000"])
        self.assertIn("a scan is damaged", table.lines[0].cells[0].note)
        self.assertIn("!: a run behind this value ended with exit code 3", table.notes[0])
        self.assertEqual(batch_report.summary(rows),
                         "2 ended well (of which 1 with warnings about the input)")
        rows[0]["exit_code"] = 0
        self.assertEqual(tables.suite_table(suite, rows).notes, [])
        self.assertEqual(batch_report.summary(rows), "2 ended well")
        rows[0].update(exit_code=3, result="x")  # It failed for something else.
        self.assertEqual(tables.suite_table(suite, rows).lines[0].cells[0].text, "x")

    def test_an_unfinished_run_is_no_failure(self):
        table = tables.suite_table(make_suite(), [row("ours", "eee_01", None, "not finished")])
        self.assertEqual(table.lines[0].cells[0].text, "…")

    def test_a_single_configuration_has_nothing_to_be_better_than(self):
        table = tables.suite_table(make_suite(), [row("ours", "eee_01", 0.1)])
        self.assertFalse(table.lines[0].cells[0].best)

    def test_speed_has_a_table_without_marks(self):
        rows = [{**row("ours", "eee_01", 0.1), "cpu_s_per_data_second": 0.1234},
                {**row("theirs", "eee_01", 0.1), "cpu_s_per_data_second": 2.0}]
        table = tables.speed_table(make_suite(configurations=("ours", "theirs")), rows)
        self.assertEqual([line.cells[0].text for line in table.lines], ["0.12", "2.00"])
        self.assertFalse(any(line.cells[0].best for line in table.lines))

    def test_an_average_has_the_marks_of_what_it_is_the_mean_of(self):
        suite = make_suite(groups=("a", "b"), average=True)
        rows = [row("ours", "a", 0.1), {**row("ours", "b", 0.3), "exit_code": 3,
                                        "evaluation_warnings": "another clock"}]
        self.assertEqual(tables.suite_table(suite, rows).lines[0].cells[-1].text, "0.2000 ! ?")

    def test_an_average_over_what_did_not_fail_says_so_and_is_not_the_best(self):
        suite = make_suite(configurations=("ours", "theirs"), groups=("a", "b"), average=True)
        rows = [row("ours", "a", 0.1), row("ours", "b", None, "x"),
                row("theirs", "a", 0.2), row("theirs", "b", 0.4)]
        table = tables.suite_table(suite, rows)
        self.assertEqual([(line.cells[-1].text, line.cells[-1].best) for line in table.lines],
                         [("0.1000 (1 of 2)", False), ("0.3000", True)])
        self.assertEqual(table.notes, ["average without b: ours (L1) 0.1000, theirs (L1) 0.2000."])
        rows[1] = row("ours", "b", 0.3)
        self.assertEqual(tables.suite_table(suite, rows).notes, [])


class FormatsTest(unittest.TestCase):
    def table(self):
        lines = [tables.Line("ours_1", "LO", "L1", True, [tables.Cell("0.1", 0.1, True, True)]),
                 tables.Line("FAST-LIO", "LIO", "L1+I", False, [tables.Cell("x")])]
        return tables.Table("ATE (%)", ["eee_01"], lines, ["a & b"])

    def test_markdown_has_bold_and_underline(self):
        text = table_formats.to_markdown(self.table())
        self.assertIn(r"| category | approach | eee_01 |", text)
        self.assertIn(r"| LO | ours_1 \* (L1) | **<u>0.1</u>** |", text)
        self.assertIn("| LIO | FAST-LIO (L1+I) | × |", text)

    def test_latex_is_escaped(self):
        text = table_formats.to_latex(self.table())
        self.assertIn(r"\caption{ATE (\%)}", text)
        self.assertIn(r"LO & ours\_1 * (L1) & \textbf{\underline{0.1}} \\", text)
        self.assertIn(r"a \& b", text)
        self.assertEqual(text.count(r"\midrule"), 2)

    def test_configurations_of_one_name_are_told_apart_by_their_sensors(self):
        lines = [tables.Line("trajlo", "LO", sensors, True, [tables.Cell("0.1")])
                 for sensors in ("L1", "L1+L2")]
        table = tables.Table("ATE", ["eee_01"], lines)
        text = table_formats.to_markdown(table)
        self.assertIn("| trajlo (L1) | 0.1 |", text)
        self.assertIn("| trajlo (L1+L2) | 0.1 |", text)

    def test_csv_has_plain_values(self):
        self.assertEqual(table_formats.to_csv(self.table()),
                         "category,approach,eee_01\nLO,ours_1 * (L1),0.1\nLIO,FAST-LIO (L1+I),x\n")

    def test_a_transposed_table_has_a_row_a_sequence(self):
        table = self.table()
        table.transposed = True
        self.assertIn("| eee_01 | **<u>0.1</u>** | × |", table_formats.to_markdown(table))


if __name__ == "__main__":
    unittest.main()
