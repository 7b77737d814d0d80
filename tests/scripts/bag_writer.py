# SPDX-License-Identifier: MIT
"""ROS 1 bags as recorders write them: one uncompressed chunk with its index. Written from the
format's description (wiki.ros.org/Bags/Format/2.0), apart from the project's own writer."""
import struct

import numpy as np

BAG_HEADER, CHUNK, CONNECTION, MESSAGE, INDEX, CHUNK_INFO = 3, 5, 7, 2, 4, 6


def fields(**values):
    """A record's header: each field is its length, then name=value."""
    parts = [name.encode() + b"=" + value for name, value in values.items()]
    return b"".join(struct.pack("<I", len(part)) + part for part in parts)


def record(op, data=b"", **values):
    header = fields(op=bytes([op]), **values)
    return struct.pack("<I", len(header)) + header + struct.pack("<I", len(data)) + data


def u32(value):
    return struct.pack("<I", value)


def ros_time(t_ns):
    return struct.pack("<II", *divmod(t_ns, 1_000_000_000))


def text(value):
    return u32(len(value)) + value.encode()


def write_bag(path, messages):
    """`messages`: (topic, type, time of recording in ns, bytes)."""
    messages = sorted(messages, key=lambda message: message[2])
    numbers, chunk, index, connections = {}, bytearray(), {}, b""
    for topic, kind, t_ns, data in messages:
        if topic not in numbers:
            numbers[topic] = len(numbers)
            described = fields(topic=topic.encode(), type=kind.encode(), md5sum=b"*",
                               message_definition=b"")
            connection = record(CONNECTION, described, conn=u32(numbers[topic]),
                                topic=topic.encode())
            connections += connection
            chunk += connection
        index.setdefault(topic, []).append((ros_time(t_ns), len(chunk)))
        chunk += record(MESSAGE, data, conn=u32(numbers[topic]), time=ros_time(t_ns))
    indices = b"".join(
        record(INDEX, b"".join(time + u32(offset) for time, offset in index[topic]), ver=u32(1),
               conn=u32(number), count=u32(len(index[topic])))
        for topic, number in numbers.items())
    body = record(CHUNK, bytes(chunk), compression=b"none", size=u32(len(chunk))) + indices
    start = len(b"#ROSBAG V2.0\n") + 4096
    counts = b"".join(u32(number) + u32(len(index[topic])) for topic, number in numbers.items())
    info = record(CHUNK_INFO, counts, ver=u32(1), chunk_pos=struct.pack("<Q", start),
                  start_time=ros_time(messages[0][2]), end_time=ros_time(messages[-1][2]),
                  count=u32(len(numbers)))
    head = {"index_pos": struct.pack("<Q", start + len(body)), "conn_count": u32(len(numbers)),
            "chunk_count": u32(1)}
    padding = 4096 - len(record(BAG_HEADER, **head))
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(b"#ROSBAG V2.0\n" + record(BAG_HEADER, b" " * padding, **head) + body +
                     connections + info)


def header(t_ns, frame, number=0):
    return u32(number) + ros_time(t_ns) + text(frame)


OUSTER = np.dtype({"names": ["x", "y", "z", "intensity", "t", "reflectivity", "ring", "ambient",
                             "range"],
                   "formats": ["<f4", "<f4", "<f4", "<f4", "<u4", "<u2", "u1", "<u2", "<u4"],
                   "offsets": [0, 4, 8, 16, 20, 24, 26, 28, 32], "itemsize": 48})
POINT_FIELD = {"u1": 2, "<u2": 4, "<u4": 6, "<f4": 7}
LIVOX = np.dtype([("offset_time", "<u4"), ("x", "<f4"), ("y", "<f4"), ("z", "<f4"),
                  ("reflectivity", "u1"), ("tag", "u1"), ("line", "u1")])


def ouster_cloud(stamp_ns, frame, xyz, t_ns):
    """sensor_msgs/PointCloud2 of Ouster's driver; `t_ns` from the sweep's start."""
    points = np.zeros(len(xyz), OUSTER)
    points["x"], points["y"], points["z"] = xyz.T
    points["t"], points["range"] = t_ns, np.linalg.norm(xyz, axis=1) * 1000
    described = b"".join(
        text(name) + struct.pack("<IBI", OUSTER.fields[name][1],
                                 POINT_FIELD[OUSTER.fields[name][0].str.replace("|", "")], 1)
        for name in OUSTER.names)
    return (header(stamp_ns, frame) + struct.pack("<II", 1, len(points)) +
            u32(len(OUSTER.names)) + described +
            struct.pack("<BII", 0, OUSTER.itemsize, points.nbytes) + u32(points.nbytes) +
            points.tobytes() + b"\1")


def livox_message(stamp_ns, frame, xyz, t_ns):
    """livox_ros_driver/CustomMsg; `t_ns` from the stamp."""
    points = np.zeros(len(xyz), LIVOX)
    points["x"], points["y"], points["z"] = xyz.T
    points["offset_time"], points["tag"] = t_ns, 0x10
    return (header(stamp_ns, frame) + struct.pack("<QIB3x", stamp_ns, len(points), 0) +
            u32(len(points)) + points.tobytes())


def pose_stamped(stamp_ns, frame, position, rotation=(0.0, 0.0, 0.0, 1.0)):
    return header(stamp_ns, frame) + struct.pack("<7d", *position, *rotation)
