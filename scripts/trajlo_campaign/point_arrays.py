# SPDX-License-Identifier: MIT
"""Points of scan files and messages as arrays with a name for each field."""
import struct

import numpy as np

TIME_FIELDS = ("time", "t", "offset_time", "timestamp")
KITTI = np.dtype([(name, "<f4") for name in ("x", "y", "z", "intensity")])
CUSTOM = np.dtype([("offset_time", "<u4"), ("x", "<f4"), ("y", "<f4"), ("z", "<f4"),
                   ("reflectivity", "u1"), ("tag", "u1"), ("line", "u1")])
# sensor_msgs/PointField: INT8 is 1.
POINT_FIELD_TYPES = (None, "i1", "u1", "<i2", "<u2", "<i4", "<u4", "<f4", "<f8")


def time_field(points):
    """The name of the field with the points' times; nothing if there is none."""
    return next((name for name in TIME_FIELDS if name in points.dtype.names), None)


def read_pcd(data):
    """The header of a binary PCD file, and its points."""
    end = data.index(b"DATA binary\n") + len(b"DATA binary\n")
    head = {line.split()[0]: line.split()[1:] for line in data[:end].decode().splitlines()}
    types = [f"<{kind.lower()}{size}" for kind, size in zip(head["TYPE"], head["SIZE"])]
    dtype = np.dtype(list(zip(head["FIELDS"], types)))
    return data[:end], np.frombuffer(data, dtype, int(head["POINTS"][0]), end).copy()


def write_pcd(header, points):
    lines = []
    for line in header.decode().splitlines():
        word = line.split()[0]
        lines.append(f"{word} {len(points)}" if word in ("WIDTH", "POINTS") else line)
    return ("\n".join(lines) + "\n").encode() + points.tobytes()


def skip_text(data, at):
    return at + 4 + struct.unpack_from("<I", data, at)[0]


def stamp_of(data):
    """The stamp in a message's header, in ns; at the same place in all messages with one."""
    seconds, nanoseconds = struct.unpack_from("<II", data, 4)
    return seconds * 1_000_000_000 + nanoseconds


def set_stamp(data, stamp_ns):
    """A stamp that ROS 1 cannot hold becomes the nearest that it can."""
    stamp_ns = min(max(stamp_ns, 0), (2**32 - 1) * 1_000_000_000)
    struct.pack_into("<II", data, 4, *divmod(stamp_ns, 1_000_000_000))


def custom_points(data):
    """Points of a livox_ros_driver/CustomMsg, as a view of its bytes."""
    at = skip_text(data, 12) + 8 + 4 + 4  # timebase, point_num, lidar_id and reserved
    return np.frombuffer(data, CUSTOM, struct.unpack_from("<I", data, at)[0], at + 4)


def cloud_points(data):
    """Points of a sensor_msgs/PointCloud2, as a view of its bytes."""
    at = skip_text(data, 12)
    height, width, count = struct.unpack_from("<III", data, at)
    at += 12
    names, offsets, types = [], [], []
    for _ in range(count):
        end = skip_text(data, at)
        names.append(bytes(data[at + 4:end]).decode())
        offset, kind, _ = struct.unpack_from("<IBI", data, end)
        offsets.append(offset)
        types.append(POINT_FIELD_TYPES[kind])
        at = end + 9
    step = struct.unpack_from("<I", data, at + 1)[0]
    dtype = np.dtype({"names": names, "offsets": offsets, "formats": types, "itemsize": step})
    return np.frombuffer(data, dtype, height * width, at + 1 + 4 + 4 + 4)
