# SPDX-License-Identifier: MIT
"""What compare_peers.py hands to a peer, and what it makes of its poses."""
import pathlib
import sys
import unittest

from support import SCRIPTS, FolderTest

try:
    import numpy as np
    from scipy.spatial.transform import Rotation
    sys.path.insert(0, str(SCRIPTS))
    import compare_peers
except ImportError:
    np = None


def random_pose(random):
    T = np.eye(4)
    T[:3, :3] = Rotation.random(random_state=random.integers(1 << 30)).as_matrix()
    T[:3, 3] = random.normal(size=3)
    return T


@unittest.skipIf(np is None, "python3-numpy, python3-scipy or python3-yaml is not installed")
class ComparePeersTest(FolderTest):
    def test_the_extrinsic_is_that_of_the_rig(self):
        rig = pathlib.Path(self.folder) / "rig.yaml"
        rig.write_text("sensor:\n  T_body_lidar:\n    - translation_m: [1, 2, 3]\n"
                       "      rotation: [0, 0, 0.7071067811865476, 0.7071067811865476]\n")
        T = compare_peers.read_extrinsic(rig)
        self.assertTrue(np.allclose(T @ [1, 0, 0, 1], [1, 3, 3, 1]))

    def test_a_peer_that_knows_the_truth_is_right_about_the_body(self):
        random = np.random.default_rng(2)
        T_body_lidar = random_pose(random)
        T_world_body = [random_pose(random) for _ in range(5)]
        T_world_lidar = [T @ T_body_lidar for T in T_world_body]
        # A peer's world is where its LiDAR began.
        from_first = [np.linalg.inv(T_world_lidar[0]) @ T for T in T_world_lidar]
        path = pathlib.Path(self.folder) / "poses.tum"
        compare_peers.write_poses(path, range(5), from_first, T_body_lidar)
        for row, T in zip(np.loadtxt(path), T_world_body):
            expected = np.linalg.inv(T_world_body[0]) @ T
            self.assertTrue(np.allclose(row[1:4], expected[:3, 3], atol=1e-8))
            self.assertTrue(np.allclose(Rotation.from_quat(row[4:]).as_matrix(),
                                        expected[:3, :3], atol=1e-8))

    def test_scans_have_their_usable_points_with_times_from_zero(self):
        path = pathlib.Path(self.folder) / "000000.pcd"
        rows = np.array([[1, 2, 3, 9, 0.02], [np.nan, 0, 0, 9, 0.0], [0, 0, 0, 9, 0.01],
                         [4, 5, 6, 9, 0.05]], np.float32)
        header = ("# .PCD v0.7\nVERSION 0.7\nFIELDS x y z intensity time\nSIZE 4 4 4 4 4\n"
                  "TYPE F F F F F\nCOUNT 1 1 1 1 1\nWIDTH 4\nHEIGHT 1\nPOINTS 4\nDATA binary\n")
        path.write_bytes(header.encode() + rows.tobytes())
        points, times_s = compare_peers.read_scan(path)
        self.assertEqual(points.tolist(), [[1, 2, 3], [4, 5, 6]])
        self.assertTrue(np.allclose(times_s, [0.0, 0.03], atol=1e-7))

    def test_the_build_is_the_one_that_the_environment_names(self):
        self.write("peers/kiss_icp.py", "")
        self.assertTrue(self.called_in_build_dir("compare_peers.py", "trajlo_simulate",
                                                 "--output=out", PYTHONPATH=self.folder / "peers"))


if __name__ == "__main__":
    unittest.main()
