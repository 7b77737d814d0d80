# SPDX-License-Identifier: MIT
"""What goes into the 3-D view of a run's page: the right places, in few bytes."""
import base64
import json
import unittest
import zlib

import numpy as np
from evaluation_folder import trajectory_json, write_evaluation
from result_folder import BEGIN_S, HEIGHT_M, ROOM, on_walls, positions, write_ply, write_result
from support import FolderTest

from trajlo_report import files, run_data, view, view_arrays, view_cloud, view_path

MAIL_MB = 15


def read_back(index, text):
    """What view/arrays.js does, in other words."""
    data = zlib.decompress(base64.b64decode(text))
    arrays = {}
    for name, entry in index.items():
        part = data[entry["offset"]:entry["offset"] + entry["bytes"]]
        size = {"uint8": 1, "float32": 4, "uint16 differences": 2}[entry["kind"]]
        bytes_of = [part[b * entry["length"]:(b + 1) * entry["length"]] for b in range(size)]
        whole = bytes(byte for value in zip(*bytes_of) for byte in value)
        kind = {1: "u1", 2: "<u2", 4: "<f4"}[size]
        values = np.frombuffer(whole, kind)
        arrays[name] = (np.cumsum(values.astype(np.int64)) % 65536
                        if entry["kind"].startswith("uint16") else values)
    return arrays


class ArraysTest(unittest.TestCase):
    def test_arrays_come_back_as_they_were(self):
        random, arrays = np.random.default_rng(1), view_arrays.Arrays()
        places = random.integers(0, 65536, 500)
        levels = random.integers(0, 256, 77)
        numbers = np.append(random.normal(0, 1e3, 40), np.nan).astype(np.float32)
        arrays.add_positions("places", places)
        arrays.add_bytes("levels", levels)
        arrays.add_floats("numbers", numbers)
        arrays.add_positions("nothing", [])
        found = read_back(arrays.index, arrays.text())
        np.testing.assert_array_equal(found["places"], places)
        np.testing.assert_array_equal(found["levels"], levels)
        np.testing.assert_array_equal(found["numbers"], numbers)
        self.assertEqual(len(found["nothing"]), 0)

    def test_morton_codes_interleave_the_bits(self):
        grid = np.random.default_rng(2).integers(0, 65536, (50, 3)).astype(np.uint16)
        for row, code in zip(grid, view_arrays.morton(grid)):
            x, y, z = (f"{value:016b}" for value in row)
            self.assertEqual(int(code), int("".join(c + b + a for a, b, c in zip(x, y, z)), 2))


class CloudTest(FolderTest):
    def test_map_points_fill_holes_and_take_time_and_intensity_of_the_nearest(self):
        scans = view_cloud.Cloud(np.array([[0.0, 0, 0], [10, 0, 0]]), np.array([1.0, 2.0]),
                                 np.array([7.0, 9.0]), np.array([1.0, 2.0]), np.array([0, 1, 2]))
        points = np.array([[0.1, 0, 0], [4.0, 0, 0], [6.5, 0, 0], [9.9, 0, 0]])
        cloud = view_cloud.fill(scans, points, budget=4)
        np.testing.assert_array_equal(cloud.points[2:], points[1:3])
        np.testing.assert_array_equal(cloud.times[2:], [1, 2])
        np.testing.assert_array_equal(cloud.intensity[2:], [7, 9])

    def test_there_are_never_more_points_than_allowed(self):
        write_result(self.folder, map_points=5000)  # and 6000 of scans
        for budget, of_scans in ((100, 100), (6000, 6000), (8000, 6000), (20000, 6000)):
            cloud = view_cloud.read_cloud(self.folder, BEGIN_S, budget)
            self.assertEqual(len(cloud.points), min(budget, 11000))
            self.assertEqual(cloud.scan_count, of_scans)
            self.assertEqual(len(cloud.moments), 20)
            self.assertLessEqual(np.ptp(np.diff(cloud.first)), 1)  # all moments alike

    def test_without_scans_there_is_the_map(self):
        write_result(self.folder, scans=False)
        cloud = view_cloud.read_cloud(self.folder, BEGIN_S)
        self.assertEqual((len(cloud.points), cloud.scan_count, len(cloud.moments)), (4000, 0, 0))

    def test_a_file_that_was_cut_off_is_named(self):
        write_result(self.folder)
        data = (self.folder / "view.ply").read_bytes()
        (self.folder / "view.ply").write_bytes(data[:-100])
        with self.assertRaisesRegex(files.ReportError, "view.ply ends early: 6000 points"):
            view_cloud.read_cloud(self.folder, BEGIN_S)

    def test_a_ceiling_is_left_away_and_an_open_sky_is_not(self):
        random, path = np.random.default_rng(3), positions(np.linspace(0, 40, 200))
        room = on_walls(random, 60000)
        cut = view_cloud.ceiling_cut(room, path)
        self.assertTrue(HEIGHT_M < cut < ROOM[1, 2], cut)
        self.assertIsNone(view_cloud.ceiling_cut(room[room[:, 2] < 2.9], path))
        # A bridge over a part of the way is none.
        bridge = room[(room[:, 2] < 2.9) | (room[:, 0] > 5)]
        self.assertIsNone(view_cloud.ceiling_cut(bridge, path))


class PathTest(FolderTest):
    def test_speed_is_that_of_the_motion_and_not_of_the_noise(self):
        times = np.arange(0, 5, 0.03)
        noise = np.random.default_rng(4).normal(0, 0.002, (len(times), 3))
        line = np.stack([1.5 * times, 0 * times, 2 * times], axis=1) + noise
        np.testing.assert_allclose(view_path.speeds(times, line), 2.5, atol=0.15)

    def test_flagged_poses_in_a_row_are_one_stretch_from_the_pose_before(self):
        result = write_result(self.folder, flags={
            30: "not_converged", 31: "not_converged", 45: "gap", 60: "no_points|degenerate"})
        found = run_data.load(result).flags
        self.assertEqual([stretch["names"] for stretch in found],
                         [["not converged"], ["gap"], ["no points", "degenerate"]])
        np.testing.assert_allclose([[item["from"], item["to"]] for item in found],
                                   [[2.9, 3.1], [4.4, 4.5], [5.9, 6.0]], atol=1e-6)

    def test_a_run_that_did_not_end_has_the_flags_of_its_windows(self):
        result = write_result(self.folder, flags={30: "not_converged", 45: "gap"})
        (result / "flags.csv").unlink()
        text = (result / "windows.csv").read_text()
        (result / "windows.csv").write_text(f"{text}101,17000")  # cut off
        found, = run_data.load(result).flags
        self.assertEqual(found["names"], ["not converged"])
        self.assertEqual(run_data.load(write_result(self.folder)).flags, [])

    def test_where_the_truth_has_a_gap_no_error_is_known(self):
        found = view_path.interpolated(np.array([0.0, 5.0, 10.0]), np.array([0, 0.1, 9.9, 10]),
                                       np.array([1.0, 1, 3, 3]))
        np.testing.assert_array_equal(found, [1, np.nan, 3])


class FrameTest(FolderTest):
    def test_everything_is_shown_where_the_evaluation_puts_the_path(self):
        result = write_result(self.folder / "result")
        turned = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])
        moved, scale = np.array([100.0, 20, 3]), 1.1
        estimate = files.Estimate("one", {"trajectory": trajectory_json(result), "alignment": {
            "T": np.column_stack([turned, moved]).tolist(), "scale": scale}}, {})
        run = run_data.load(result, [estimate])
        np.testing.assert_allclose(
            run.positions, scale * positions(run.times - BEGIN_S) @ turned.T + moved, atol=1e-5)
        np.testing.assert_allclose(run.rotations, np.broadcast_to(turned, (len(run.times), 3, 3)),
                                   atol=1e-12)
        low = scale * np.array([-ROOM[1, 1], ROOM[0, 0], ROOM[0, 2]]) + moved
        np.testing.assert_allclose(run.cloud.points.min(axis=0), low, atol=1e-3)

    def test_the_estimate_that_is_this_trajectory_is_taken_and_no_other(self):
        result = write_result(self.folder / "result")
        own = trajectory_json(result)
        others = [{**own, "path_length_m": own["path_length_m"] + 1e-4},
                  {**own, "end_s": "1700000009.900000000"}, {**own, "path_length_m": None}, None]
        items = [files.Estimate("other", {"trajectory": other}, {}) for other in others]
        self.assertIsNone(run_data.load(result, items).estimate)
        run = run_data.load(result, [*items, files.Estimate("own", {"trajectory": own}, {})])
        self.assertEqual((run.estimate.name, run.missing), ("own", []))

    def test_the_evaluation_of_an_estimate_that_exploded_is_found(self):
        result = write_result(self.folder / "result")
        own = trajectory_json(result)
        for line, changed in (("1700000011 nan 2 3 0 0 0 1", {}),
                              ("1700000012 1e300 2 3 0 0 0 1",
                               {"end_s": "1700000012.000000000", "path_length_m": None})):
            text = (result / "trajectory.tum").read_text()
            (result / "trajectory.tum").write_text(f"{text}{line}\n")
            estimate = files.Estimate("own", {"trajectory": {**own, **changed}}, {})
            self.assertIs(run_data.load(result, [estimate]).estimate, estimate)


class ViewTest(FolderTest):
    def make(self, run):
        description, text = view.make(run)
        page = json.loads(description)
        return page, read_back(page["arrays"], text)

    def places(self, page, arrays):
        grid = np.stack([arrays[f"cloud_{axis}"] for axis in "xyz"], axis=1)
        return np.array(page["cloud"]["corner"]) + page["cloud"]["step_m"] * grid

    def test_each_moment_has_its_own_points_where_they_are(self):
        result = write_result(self.folder)
        page, arrays = self.make(run_data.load(result))
        columns = files.read_ply_columns(result / "view.ply")
        points, first = files.read_ply(result / "view.ply"), page["cloud"]["first"]
        shown = self.places(page, arrays)
        self.assertLess(page["cloud"]["step_m"], 5e-4)
        for index, moment in enumerate(page["cloud"]["moments_s"]):
            own = points[columns["t_s"] == np.float32(moment)]
            there = shown[first[index]:first[index + 1]]
            distance = np.linalg.norm(own[:, None] - there[None], axis=2).min(axis=1)
            self.assertLess(distance.max(), page["cloud"]["step_m"])

    def test_coordinates_of_a_map_projection_keep_their_centimetres(self):
        result = write_result(self.folder / "result")
        far = np.array([691_234.5, 5_334_321.25, 512.0])
        estimate = files.Estimate("one", {"trajectory": trajectory_json(result), "alignment": {
            "T": np.column_stack([np.eye(3), far]).tolist(), "scale": 1.0}}, {})
        page, arrays = self.make(run_data.load(result, [estimate]))
        path = arrays["path_xyz"].reshape(-1, 3).astype(float) + page["origin"]
        np.testing.assert_allclose(path, positions(arrays["path_t"]) + far, atol=1e-3)

    def test_the_truth_and_the_errors_are_there_with_an_evaluation(self):
        result = write_result(self.folder / "result", seconds=40)
        _, estimates = files.read_evaluation(write_evaluation(self.folder / "evaluation",
                                                              {"one": 0.01}, of=result))
        page, arrays = self.make(run_data.load(result, estimates))
        self.assertEqual([item["key"] for item in page["path"]["quantities"]],
                         ["error", "speed", "inliers", "agreement", "eigenvalue"])
        errors = 100 * np.interp(arrays["path_t"], estimates[0].times - BEGIN_S,
                                 estimates[0].errors["translation_error_m"])
        np.testing.assert_allclose(arrays["path_error"], errors, atol=1e-3)
        np.testing.assert_allclose(arrays["truth_xyz"].reshape(-1, 3), estimates[0].truth,
                                   atol=1e-5)

    def test_a_name_cannot_end_the_script(self):
        result = write_result(self.folder)
        run = run_data.load(result)
        run.flags = [{"from": 0.0, "to": 1.0, "names": ["</script>"]}]
        self.assertNotIn("</script", view.make(run)[0])

    def test_a_million_points_without_any_order_can_be_mailed(self):
        result = write_result(self.folder, map_points=10)
        random, count = np.random.default_rng(5), view_cloud.BUDGET
        write_ply(result / "view.ply", {
            **dict(zip("xyz", random.uniform(-150, 150, (3, count)))),
            "intensity": random.uniform(0, 255, count),
            "t_s": np.sort(random.integers(0, 300, count)) * 0.5}, f"comment begin_s {BEGIN_S:.9f}")
        page = view.embedded(run_data.load(result))
        size = sum(len(text) for text in (page["description"], page["arrays"], page["code"],
                                          page["style"], *page["library"]))
        self.assertLess(size, 0.8e6 * MAIL_MB)  # and there are figures


if __name__ == "__main__":
    unittest.main()
