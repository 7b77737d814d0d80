# SPDX-License-Identifier: MIT
"""Figures say what they show: no text is cut off, no legend hides data, marks have names."""
import unittest
import unittest.mock

import numpy as np
from evaluation_folder import write_evaluation
from result_folder import write_result
from support import FolderTest
from test_comparison_page import VARIANTS, variant

from trajlo_report import (figures_comparison, figures_errors, figures_path, figures_run, files,
                           run_data, theme)


def legend_texts(figure):
    legends = [*figure.legends, *(axes.get_legend() for axes in figure.axes)]
    return {text.get_text() for legend in legends if legend for text in legend.get_texts()}


class FiguresTest(FolderTest):
    def setUp(self):
        super().setUp()
        theme.apply()
        self.addCleanup(theme.plt.close, "all")

    def estimates(self):
        return files.read_evaluation(write_evaluation(self.folder / "evaluation",
                                                      {"one": 0.01, "two": 0.2}))[1]

    def assert_all_text_is_inside(self, figure):
        figure.canvas.draw()
        for axes in figure.axes:
            box = axes.get_tightbbox()  # with labels and ticks
            self.assertTrue(min(box.x0, box.y0) > -1 and box.x1 < figure.bbox.x1 + 1
                            and box.y1 < figure.bbox.y1 + 1, axes.get_xlabel())

    def test_no_text_of_a_comparison_is_cut_off(self):
        names = ["a_yardstick", "kernel_geman_mcclure"] + [f"name_{i}" for i in range(14)]
        variants = [variant(name, *VARIANTS[i % len(VARIANTS)][1:]) for i, name in enumerate(names)]
        for draw in (figures_comparison.draw_stages, figures_comparison.draw_free):
            figure = draw(variants, theme.COLUMN_IN)
            self.assert_all_text_is_inside(figure)
            widths = [axes.get_position().width for axes in figure.axes]
            self.assertGreater(sum(widths), 0.5)  # no empty half

    def test_errors_over_time_say_of_what(self):
        figure = figures_errors.draw_over_time(self.estimates())
        self.assertEqual([axes.get_ylabel() for axes in figure.axes[3:]],
                         ["position\nerror [m]", "rotation\nerror [°]"])
        self.assert_all_text_is_inside(figure)

    def test_the_start_has_a_name(self):
        estimates = self.estimates()
        for draw in (figures_path.draw_planes, figures_path.draw_error_on_path):
            figure = draw(estimates)
            self.assertIn("start", legend_texts(figure))
            self.assertIn("truth", legend_texts(figure))
            self.assert_all_text_is_inside(figure)

    def test_of_planes_alike_that_seen_from_above_is_drawn(self):
        low = np.zeros(3)
        for high, axes in (((9, 2, 2), [0, 1]), ((2, 9, 2), [0, 1]), ((2, 1, 9), [0, 2]),
                           ((9, 2, 2 + 1e-12), [0, 1])):
            self.assertEqual(list(figures_path.widest_plane(low, np.array(high))), axes)

    def test_the_planes_of_a_straight_path_have_a_scale(self):
        estimates = self.estimates()
        for item in estimates:
            for name in ("y", "z"):
                item.errors[f"{name}_m"] = item.errors[f"{name}_true_m"] = (
                    4.4 + 0.01 * item.errors[f"{name}_true_m"])
        figure = figures_path.draw_planes(estimates)
        figure.canvas.draw()
        for axes in figure.axes:
            low, high = axes.get_ylim()
            self.assertGreaterEqual(sum(low <= tick <= high for tick in axes.get_yticks()), 2)

    def test_the_legend_of_the_position_lies_on_no_line(self):
        run = run_data.load(write_result(self.folder / "result"))
        run.positions[:, 1] = run.positions[:, 0].max()  # a line at the upper edge
        figure = figures_run.draw_windows(run)
        figure.canvas.draw()
        axes = figure.axes[0]
        box = axes.get_legend().get_window_extent()
        for line in axes.lines:
            places = axes.transData.transform(line.get_xydata())
            self.assertFalse(any(box.contains(x, y) for x, y in places))

    def test_a_figure_is_laid_out_once_for_all_its_formats(self):
        figure = figures_run.draw_windows(run_data.load(write_result(self.folder / "result")))
        engine = figure.get_layout_engine()
        with unittest.mock.patch.object(engine, "execute", wraps=engine.execute) as laid_out:
            theme.save(figure, self.folder / "windows")
        self.assertEqual(laid_out.call_count, 1)


if __name__ == "__main__":
    unittest.main()
