# SPDX-License-Identifier: MIT
"""What trajlo_convert writes, read by tools that are not ours.

Needs mcap, mcap-ros2-support and rosbags, which Debian does not have:

    pip install --target READERS mcap mcap-ros2-support rosbags "numpy<2"
    PYTHONPATH=READERS python3 -m unittest test_exports

Without them the tests are skipped.
"""
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np
import yaml
from scipy.spatial import cKDTree

from support import ROOT

try:
    from mcap.reader import SeekingReader, make_reader
    from mcap.stream_reader import StreamReader
    from mcap_ros2.decoder import DecoderFactory
    from rosbags.rosbag1 import Reader as Ros1Reader
    from rosbags.rosbag2 import Reader as Ros2Reader
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore
    MISSING = ""
except ImportError as error:
    MISSING = f"pip install mcap mcap-ros2-support rosbags: {error}"

TOPICS = ["lidar0/points_deskewed", "lidar1/points_deskewed", "map", "odometry", "path", "tf",
          "tf_static"]
COUNTED = ["/lidar0/points_deskewed", "/lidar1/points_deskewed", "/odometry", "/tf"]


def call(program, *arguments):
    build = os.environ.get("TRAJLO_BUILD_DIR", ROOT / "build")
    command = [f"{build}/apps/{program}", *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, f"{' '.join(command)}: {done.stderr}"
    return done


def points_of(cloud):
    """A PointCloud2 of float32 as a table, and its names."""
    names = [field.name for field in cloud.fields]
    assert [field.offset for field in cloud.fields] == [4 * i for i in range(len(names))]
    assert {field.datatype for field in cloud.fields} == {7}
    values = np.frombuffer(bytes(cloud.data), "<f4").reshape(-1, len(names))
    assert len(values) == cloud.width and cloud.height == 1
    assert cloud.row_step == cloud.point_step * cloud.width
    return values, names


def matrix_of(translation, rotation):
    x, y, z, w = rotation.x, rotation.y, rotation.z, rotation.w
    matrix = np.eye(4)
    matrix[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                      [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                      [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    matrix[:3, 3] = [translation.x, translation.y, translation.z]
    return matrix


def nanoseconds(stamp):
    return stamp.sec * 10**9 + stamp.nanosec


@unittest.skipIf(MISSING, MISSING)
class Exports(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = folder = pathlib.Path(cls.temporary.name)
        call("trajlo_simulate", "--scenario=hall_os1_16x2", f"--output={folder / 'hall'}",
             "--duration_s=4", "--format=bag")
        cls.bag = folder / "hall" / "recording.bag"
        call("trajlo_run", f"--input={cls.bag}", f"--output={folder / 'result'}",
             f"--config={folder / 'hall' / 'rig.yaml'}", "--covariance", "--quiet")
        cls.result = folder / "result"
        for name in ("all.mcap", "all.db3", "all.bag", "copy.mcap"):
            call("trajlo_convert", cls.result if name[0] == "a" else cls.bag, folder / name)
        cls.poses = np.loadtxt(cls.result / "trajectory.tum")

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def decoded(self, name, **how):
        """{topic: [(log time, message)]} by the indices of an MCAP file."""
        messages = {}
        with open(self.folder / name, "rb") as file:
            reader = make_reader(file, decoder_factories=[DecoderFactory()])
            self.assertIsInstance(reader, SeekingReader)
            for _, channel, message, ros in reader.iter_decoded_messages(**how):
                messages.setdefault(channel.topic, []).append((message.log_time, ros))
        return messages

    def test_mcap_has_all_topics_and_its_statistics_are_right(self):
        messages = self.decoded("all.mcap")
        self.assertEqual(sorted(messages), ["/" + topic for topic in TOPICS])
        with open(self.folder / "all.mcap", "rb") as file:
            summary = make_reader(file).get_summary()
            self.assertEqual(make_reader(file).get_header().profile, "ros2")
        times = [time for entries in messages.values() for time, _ in entries]
        self.assertEqual(summary.statistics.message_count, len(times))
        self.assertEqual(summary.statistics.message_start_time, min(times))
        self.assertEqual(summary.statistics.message_end_time, max(times))
        self.assertEqual(summary.statistics.chunk_count, len(summary.chunk_indexes))
        for number, count in summary.statistics.channel_message_counts.items():
            self.assertEqual(count, len(messages[summary.channels[number].topic]))
        self.assertTrue(all(schema.encoding == "ros2msg" for schema in summary.schemas.values()))
        self.assertTrue(all(index.compression == "zstd" for index in summary.chunk_indexes))

    def test_checksums_and_records_hold_when_the_file_is_streamed(self):
        with open(self.folder / "all.mcap", "rb") as file:
            kinds = [type(record).__name__ for record in
                     StreamReader(file, validate_crcs=True).records]
        self.assertGreater(kinds.count("Message"), 200)
        self.assertEqual(kinds[0], "Header")
        self.assertEqual(kinds[-1], "Footer")

    def test_a_player_can_seek(self):
        everything = self.decoded("all.mcap")["/tf"]
        middle = everything[len(everything) // 2][0]
        some = self.decoded("all.mcap", topics=["/tf"], start_time=middle,
                            end_time=middle + 10**9)
        expected = [time for time, _ in everything if middle <= time < middle + 10**9]
        self.assertEqual([time for time, _ in some["/tf"]], expected)
        self.assertGreater(len(expected), 30)

    def test_the_path_is_the_trajectory(self):
        ((time, path),) = self.decoded("all.mcap", topics=["/path"])["/path"]
        self.assertEqual(path.header.frame_id, "world")
        self.assertEqual(len(path.poses), len(self.poses))
        for pose, row in zip(path.poses, self.poses):
            at, turn = pose.pose.position, pose.pose.orientation
            self.assertAlmostEqual(1e-9 * nanoseconds(pose.header.stamp), row[0], places=5)
            np.testing.assert_allclose([at.x, at.y, at.z, turn.x, turn.y, turn.z, turn.w], row[1:],
                                       atol=2e-9)
        self.assertEqual(time, nanoseconds(path.poses[0].header.stamp))

    def test_deskewed_scans_lie_on_the_map_when_tf_places_them(self):
        messages = self.decoded("all.mcap")
        frames = {time: matrix_of(tf.transforms[0].transform.translation,
                                  tf.transforms[0].transform.rotation)
                  for time, tf in messages["/tf"]}
        values, names = points_of(messages["/map"][0][1])
        self.assertEqual(names, ["x", "y", "z", "intensity", "normal_x", "normal_y", "normal_z",
                                 "curvature"])
        tree = cKDTree(values[:, :3])
        for topic in ("/lidar0/points_deskewed", "/lidar1/points_deskewed"):
            for time, cloud in messages[topic][5:40:10]:
                self.assertEqual(cloud.header.frame_id, "body")
                self.assertEqual(nanoseconds(cloud.header.stamp), time)
                points = points_of(cloud)[0][:, :3]
                placed = points @ frames[time][:3, :3].T + frames[time][:3, 3]
                # No point is farther from the mean of its voxel than the diagonal.
                self.assertLess(tree.query(placed)[0].max(), 0.12 * 3**0.5 + 1e-3)

    def test_static_frames_are_the_extrinsics(self):
        rig = yaml.safe_load((self.folder / "hall" / "rig.yaml").read_text())
        expected = [[*lidar["translation_m"], *lidar["rotation"]]
                    for lidar in rig["sensor"]["T_body_lidar"]]
        ((_, static),) = self.decoded("all.mcap", topics=["/tf_static"])["/tf_static"]
        self.assertEqual([tf.child_frame_id for tf in static.transforms], ["lidar0", "lidar1"])
        for tf, numbers in zip(static.transforms, expected):
            at, turn = tf.transform.translation, tf.transform.rotation
            np.testing.assert_allclose([at.x, at.y, at.z, turn.x, turn.y, turn.z, turn.w], numbers,
                                       atol=1e-9)

    def test_covariances_are_turned_into_the_world(self):
        rows = np.genfromtxt(self.result / "covariance.csv", delimiter=",", names=True)
        odometry = self.decoded("all.mcap", topics=["/odometry"])["/odometry"]
        names = [f"{axis}_{k}" for axis in ("rho", "theta") for k in "xyz"]
        for k in (5, 40, len(rows) - 3):
            sigma = np.zeros((6, 6))
            for i in range(6):
                for j in range(i, 6):
                    sigma[i, j] = sigma[j, i] = rows[f"{names[i]}__{names[j]}"][k]
            pose = odometry[k][1].pose
            turn = np.kron(np.eye(2), matrix_of(pose.pose.position,
                                                pose.pose.orientation)[:3, :3])
            found = np.array(pose.covariance).reshape(6, 6)
            np.testing.assert_allclose(found, turn @ sigma @ turn.T, atol=1e-6 * abs(sigma).max())

    def test_velocities_are_differences_of_poses(self):
        odometry = [ros for _, ros in self.decoded("all.mcap", topics=["/odometry"])["/odometry"]]
        for before, after in zip(odometry[20:60], odometry[21:]):
            seconds = 1e-9 * (nanoseconds(after.header.stamp) - nanoseconds(before.header.stamp))
            a = matrix_of(before.pose.pose.position, before.pose.pose.orientation)
            b = matrix_of(after.pose.pose.position, after.pose.pose.orientation)
            speed = a[:3, :3].T @ (b[:3, 3] - a[:3, 3]) / seconds
            found = after.twist.twist.linear
            np.testing.assert_allclose([found.x, found.y, found.z], speed, atol=0.02)

    def test_db3_and_ros1_hold_the_same_messages(self):
        expected = self.decoded("all.mcap")
        store = get_typestore(Stores.ROS2_HUMBLE)
        with Ros2Reader(self.folder / "all.db3") as reader:
            self.assertEqual(sorted(c.topic for c in reader.connections), sorted(expected))
            for topic in COUNTED:
                chosen = [c for c in reader.connections if c.topic == topic]
                times = [time for _, time, _ in reader.messages(connections=chosen)]
                self.assertEqual(times, [time for time, _ in expected[topic]])
            for connection, _, data in reader.messages():
                store.deserialize_cdr(data, connection.msgtype)
            latched = {c.topic for c in reader.connections
                       if c.ext.offered_qos_profiles[0].durability.name == "TRANSIENT_LOCAL"}
            self.assertEqual(latched, {"/map", "/path", "/tf_static"})
        with Ros1Reader(self.folder / "all.bag") as reader:
            store = get_typestore(Stores.ROS1_NOETIC)
            for connection in reader.connections:
                store.register(get_types_from_msg(connection.msgdef.data, connection.msgtype))
            for connection in reader.connections:
                # The MD5 sum by the text of the interface, as roscpp computes it.
                digest = store.generate_msgdef(connection.msgtype, ros_version=1)[1]
                self.assertEqual(connection.digest, digest, connection.msgtype)
            count = 0
            for connection, time, data in reader.messages():
                store.deserialize_ros1(data, connection.msgtype)
                count += 1
            self.assertEqual(count, sum(map(len, expected.values())))

    def test_copied_bags_keep_every_field(self):
        store = get_typestore(Stores.ROS1_NOETIC)
        copies = self.decoded("copy.mcap")
        with Ros1Reader(self.bag) as reader:
            counts = {}
            for connection, time, data in reader.messages():
                at = counts.setdefault(connection.topic, 0)
                counts[connection.topic] += 1
                if at % 50 > 0:
                    continue
                original = store.deserialize_ros1(data, connection.msgtype)
                log_time, copy = copies[connection.topic][at]
                self.assertEqual(log_time, time)
                self.assertEqual(nanoseconds(copy.header.stamp), nanoseconds(original.header.stamp))
                if connection.msgtype.endswith("PointCloud2"):
                    self.assertEqual(bytes(copy.data), bytes(original.data))
                    self.assertEqual([f.name for f in copy.fields],
                                     [f.name for f in original.fields])
                else:
                    self.assertEqual(copy.pose.position.x, original.pose.position.x)
                    self.assertEqual(copy.pose.orientation.w, original.pose.orientation.w)
        self.assertEqual(counts, {topic: len(entries) for topic, entries in copies.items()})

    def test_there_and_back_nothing_is_lost(self):
        call("trajlo_convert", self.folder / "copy.mcap", self.folder / "back.db3")
        call("trajlo_convert", self.folder / "back.db3", self.folder / "back.bag")

        def digest(path):
            store = get_typestore(Stores.ROS1_NOETIC)
            rows = []
            with Ros1Reader(path) as reader:
                for connection, time, data in reader.messages():
                    # Behind the sequence number, which ROS 2 does not know.
                    rows.append((connection.topic, time, bytes(data[4:])))
                    self.assertIn(connection.msgtype, store.fielddefs)
            return sorted(rows)
        self.assertEqual(digest(self.bag), digest(self.folder / "back.bag"))

    def test_compressions_give_the_same_messages(self):
        def raw(name):
            with open(self.folder / name, "rb") as file:
                return [(c.topic, m.log_time, m.data) for _, c, m in make_reader(
                    file).iter_messages()]
        for compression in ("lz4", "none"):
            name = f"{compression}.mcap"
            call("trajlo_convert", self.result, self.folder / name, f"--compression={compression}")
            self.assertEqual(raw(name), raw("all.mcap"))


if __name__ == "__main__":
    unittest.main()
