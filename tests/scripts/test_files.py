# SPDX-License-Identifier: MIT
"""What pages read is read whole, or refused with its place."""
import unittest

import numpy as np
from support import FolderTest

from trajlo_report import files, view_path

HEAD = "ply\nformat binary_little_endian 1.0\nelement vertex 2\n"


class TumTest(FolderTest):
    def read(self, text):
        return files.read_tum(self.write("a.tum", text))

    def test_stamps_keep_their_nanoseconds(self):
        times_ns, positions, quaternions = self.read(
            "# a comment\n\n1700000000.123456789 1 2 3 0 0 0 1\n1.7e9 4 5 6 0 0 1 0\n")
        self.assertEqual(times_ns.tolist(), [1700000000123456789, 1700000000000000000])
        np.testing.assert_array_equal(positions, [[1, 2, 3], [4, 5, 6]])
        np.testing.assert_array_equal(quaternions, [[0, 0, 0, 1], [0, 0, 1, 0]])

    def test_only_an_unfinished_last_line_is_left_out(self):
        pose = "1 1 2 3 0 0 0 1\n"
        for rest in ("2 1 2", "2 1 2 3 0 0 0 -", "2"):
            self.assertEqual(len(self.read(pose + rest)[0]), 1)
        self.assertEqual(len(self.read(pose + "2 1 2 3 0 0 0 1")[0]), 2)
        for line in ("2 1 2", "t x y z qx qy qz qw", "2 1 2 3 0 0 0 1 9", "nan 1 2 3 0 0 0 1",
                     "inf 1 2 3 0 0 0 1"):
            with self.assertRaisesRegex(files.ReportError, "a.tum: line 2 is not 'stamp x y z"):
                self.read(f"{pose}{line}\n{pose}")


class PlyTest(FolderTest):
    def read(self, head, values):
        path = self.folder / "a.ply"
        path.write_bytes(head.encode() + b"end_header\n" + values)
        return files.read_ply_columns(path)

    def test_columns_have_their_values(self):
        found = self.read(HEAD + "property float x\nproperty float t\n",
                          np.arange(4, dtype="<f4").tobytes())
        self.assertEqual({name: values.tolist() for name, values in found.items()},
                         {"x": [0, 2], "t": [1, 3]})

    def test_other_types_and_elements_are_not_taken_for_floats(self):
        for more in ("property uchar red\n", "property int y\n",
                     "element face 1\nproperty float y\n"):
            with self.assertRaisesRegex(files.ReportError, "more than vertices of floats"):
                self.read(HEAD + "property float x\n" + more, bytes(100))


class CsvTest(FolderTest):
    ROW = {"lost": True, "in_doubt": np.False_, "seed": 1, "error_m": 0.1, "reason": None}

    def test_truth_values_are_written_as_in_json(self):
        self.assertEqual(files.to_csv([self.ROW]),
                         "lost,in_doubt,seed,error_m,reason\ntrue,false,1,0.1,\n")

    def test_they_are_read_as_texts_beside_numbers(self):
        columns = files.read_columns(self.write("results.csv", files.to_csv([self.ROW])))
        self.assertEqual(columns["lost"], ["true"])
        np.testing.assert_array_equal(columns["seed"], [1.0])


class GapsTest(unittest.TestCase):
    def test_a_time_is_in_a_gap_if_both_its_neighbours_are_far(self):
        known = np.array([0.0, 1.0, 5.0])
        times = np.array([-1.5, -0.5, 0.0, 0.5, 2.5, 4.5, 5.0, 5.5, 7.0])
        np.testing.assert_array_equal(view_path.in_gaps(times, known),
                                      [1, 0, 0, 0, 1, 0, 0, 0, 1])
        np.testing.assert_array_equal(view_path.in_gaps(times, known[:1]),
                                      [1, 0, 0, 0, 1, 1, 1, 1, 1])


if __name__ == "__main__":
    unittest.main()
