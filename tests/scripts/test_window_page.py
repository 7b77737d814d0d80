# SPDX-License-Identifier: MIT
"""The factor graph of a window, as trajlo_run writes it, read and drawn."""
import json
import pathlib
import shutil
import subprocess
import tempfile

import numpy as np

from support import SCRIPTS, FolderTest, built
from trajlo_report import files, window_graph


def rotation(quaternion):
    """Of qx qy qz qw."""
    x, y, z, w = quaternion
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


class WindowPageTest(FolderTest):

    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory(prefix="trajlo_window_")
        cls.addClassCleanup(holder.cleanup)
        folder = pathlib.Path(holder.name)
        subprocess.run([built("trajlo_simulate"), "hall_os1_16", "-o", folder / "rec",
                        "--duration_s=1.2"], check=True, capture_output=True)
        subprocess.run([built("trajlo_run"), folder / "rec", "-o", folder / "result",
                        "--inspect=12,20-21", "--noview", "--quiet"], check=True,
                       capture_output=True)
        cls.made = folder / "result"

    def setUp(self):
        super().setUp()
        self.result = self.folder / "result"
        shutil.copytree(self.made, self.result)

    def draw(self, *arguments):
        return subprocess.run([SCRIPTS / "draw_window.py", self.result, *arguments],
                              capture_output=True, text=True, check=False)

    def test_all_windows_have_a_page_that_holds_everything(self):
        done = self.draw()
        self.assertEqual(done.returncode, 0, done.stderr)
        for number in (12, 20, 21):
            page = self.result / f"windows/{number:06d}.html"
            self.assert_self_contained(page)
            text = page.read_text()
            self.assertIn(f"Window {number}", text)
            self.assertEqual(text.count("<img "), 3)
            self.assertIn("marginalisation prior", text)

    def test_one_window_is_drawn_where_one_is_named(self):
        self.assertEqual(self.draw("20").returncode, 0)
        pages = sorted(path.name for path in (self.result / "windows").glob("*.html"))
        self.assertEqual(pages, ["000020.html"])
        absent = self.draw("3")
        self.assertEqual(absent.returncode, 2)
        self.assertIn("000003.json is missing", absent.stderr)

    def test_a_run_without_graphs_says_how_to_get_them(self):
        shutil.rmtree(self.result / "windows")
        done = self.draw()
        self.assertEqual(done.returncode, 2)
        self.assertIn("--inspect", done.stderr)

    def test_a_cut_file_is_named(self):
        path = self.result / "windows/000012.ply"
        path.write_bytes(path.read_bytes()[:-100])
        done = self.draw("12")
        self.assertEqual(done.returncode, 2)
        self.assertIn("ends early", done.stderr)

    def test_another_json_file_is_refused(self):
        (self.result / "windows/000012.json").write_text(json.dumps({"H": [1]}))
        self.assertIn("is no factor graph", self.draw("12").stderr)

    def test_the_kinds_of_factors_are_told_apart(self):
        graph = window_graph.load(self.result / "windows/000021.json")
        np.testing.assert_allclose(graph.total(), graph.document["H"])
        # The points of a segment move along its normals with both of its poses, and with no other.
        registration = graph.information["registration"]
        blocks = np.abs(registration).reshape(graph.poses, 6, graph.poses, 6).max(axis=(1, 3))
        apart = np.abs(np.subtract.outer(range(graph.poses), range(graph.poses)))
        self.assertLess(blocks[apart > 1].max(), 1e-9 * blocks.max())
        self.assertGreater(blocks[apart <= 1].min(), 1e-6 * blocks.max())
        # All poses moved along x of the world move all points by as much.
        for axis, normal in enumerate(("nx", "ny", "nz")):
            unit = np.eye(3)[axis]
            move = np.concatenate([np.concatenate([rotation(pose[3:]).T @ unit, np.zeros(3)])
                                   for pose in graph.document["poses"]])
            expected = (graph.points["information"] * graph.points[normal]**2).sum()
            self.assertAlmostEqual(move @ registration @ move / expected, 1.0, places=6)

    def test_fewer_factors_know_less(self):
        graph = window_graph.load(self.result / "windows/000020.json")
        every = graph.newest_sigmas()
        for without in (("prior",), ("motion",), ("prior", "motion")):
            self.assertTrue((graph.newest_sigmas(without) >= every * (1 - 1e-9)).all())
        self.assertTrue(np.isinf(graph.newest_sigmas(("registration", "prior"))).any())

    def test_it_is_near_its_minimum(self):
        graph = window_graph.load(self.result / "windows/000020.json")
        step_m, step_rad = graph.step_to_minimum()
        self.assertLess(step_m, 5e-3)
        self.assertLess(step_rad, 1e-3)

    def test_a_window_whose_points_have_no_weight_is_drawn(self):
        path = self.result / "windows/000012.ply"
        columns = files.read_ply_columns(path)
        rows = np.array(list(zip(*columns.values())))
        for name in ("weight", "information"):
            rows[:, list(columns).index(name)] = 0.0
        head = path.read_bytes().partition(b"end_header\n")[0] + b"end_header\n"
        path.write_bytes(head + rows.astype("<f8").tobytes())
        done = self.draw("12")
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_doubles_and_floats_of_a_ply_are_read(self):
        path = self.folder / "mixed.ply"
        rows = np.array([(1.5, 2.0), (-3.25, 1e-300)], dtype=[("a", "<f4"), ("b", "<f8")])
        path.write_bytes(b"ply\nformat binary_little_endian 1.0\nelement vertex 2\n"
                         b"property float a\nproperty double b\nend_header\n" + rows.tobytes())
        columns = files.read_ply_columns(path)
        np.testing.assert_array_equal(columns["a"], rows["a"])
        np.testing.assert_array_equal(columns["b"], rows["b"])
