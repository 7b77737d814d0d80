#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Writes the first inputs of the fuzz targets that no fixture of another test can serve.

usage: make_corpus.py        (writes beside itself, into corpus/)
"""
import struct
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "scripts"))
import bag_writer  # noqa: E402

CORPUS = Path(__file__).parent / "corpus"
PACKETS = Path(__file__).parents[1] / "core/io/packets/fixtures"
STAMP = (1_600_000_000, 100_000_000)


def write(target, name, content):
    folder = CORPUS / target
    folder.mkdir(parents=True, exist_ok=True)
    (folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())


class Message:
    """A message in ROS 1's encoding, or in CDR, which aligns numbers and ends strings with 0."""

    def __init__(self, cdr):
        self.cdr = cdr
        self.bytes = b""

    def number(self, code, *values):
        for value in values:
            size = struct.calcsize(code)
            if self.cdr:
                self.bytes += bytes(-len(self.bytes) % size)
            self.bytes += struct.pack("<" + code, value)
        return self

    def text(self, text):
        encoded = text.encode() + (b"\0" if self.cdr else b"")
        self.number("I", len(encoded))
        self.bytes += encoded
        return self

    def header(self):
        if not self.cdr:
            self.number("I", 7)
        return self.number("I", *STAMP).text("lidar")

    def whole(self):
        return (b"\0\1\0\0" if self.cdr else b"") + self.bytes


def point_cloud2(cdr, time_type="f"):
    fields = [("x", 7), ("y", 7), ("z", 7), ("intensity", 7),
              ("time", 7) if time_type == "f" else ("timestamp", 8)]
    points = b"".join(struct.pack("<4f" + time_type, i, 2.0, 0.5 * i, 9.0, 0.01 * i)
                      for i in range(6))
    step = len(points) // 6
    message = Message(cdr).header().number("I", 1, 6, len(fields))
    for place, (name, code) in enumerate(fields):
        message.text(name).number("I", 4 * place).number("B", code).number("I", 1)
    message.number("B", 0).number("I", step, len(points), len(points))
    message.bytes += points
    return message.number("B", 1).whole()


def livox(cdr):
    message = Message(cdr).header().number("Q", STAMP[0] * 10**9 + STAMP[1]).number("I", 4)
    message.number("B", 1, 0, 0, 0).number("I", 4)
    for i in range(4):
        message.number("I", 1000 * i).number("f", 1.0 + i, 2.0, 0.5).number("B", 30, 16, i)
    return message.whole()


def pose(cdr, kind):
    message = Message(cdr).header()
    if kind in ("TransformStamped", "Odometry"):
        message.text("base")
    message.number("d", 1.0, 2.0, 0.5)
    if kind != "PointStamped":
        message.number("d", 0.0, 0.0, 0.6, 0.8)
    if kind in ("PoseWithCovarianceStamped", "Odometry"):
        message.number("d", *([0.01] * 36))
    if kind == "Odometry":
        message.number("d", *([0.0] * 42))
    return message.whole()


def messages():
    for cdr in (0, 1):
        encoding = "cdr" if cdr else "ros1"
        write("cloud_message", f"point_cloud2_{encoding}", bytes([cdr]) + point_cloud2(cdr))
        write("cloud_message", f"doubles_{encoding}", bytes([cdr]) + point_cloud2(cdr, "d"))
        write("cloud_message", f"livox_{encoding}", bytes([2 + cdr]) + livox(cdr))
        for i, kind in enumerate(("PoseStamped", "PoseWithCovarianceStamped", "TransformStamped",
                                  "PointStamped", "Odometry")):
            write("pose_message", f"{kind}_{encoding}", bytes([2 * i + cdr]) + pose(cdr, kind))


def bags():
    cloud = "sensor_msgs/PointCloud2"
    for name, second in (("two_clouds", point_cloud2(False, "d")), ("found_empty_message", b"")):
        bag_writer.write_bag(CORPUS / "ros1_bag" / name,
                             [("/points", cloud, 1_600_000_000_200_000_000, point_cloud2(False)),
                              ("/points2", cloud, 1_600_000_000_100_000_000, second)])


def udp_payloads(capture):
    """Of a capture of Ethernet frames with IPv4, microseconds, low byte first."""
    at = 24
    while at < len(capture):
        size = struct.unpack_from("<I", capture, at + 8)[0]
        yield capture[at + 16 + 14 + 20 + 8:at + 16 + size]
        at += 16 + size


def packets():
    for i, model in enumerate(("vlp16", "puck_hi_res", "hdl32e", "vlp32c")):
        packet = (PACKETS / f"velodyne_{model}_dual.bin").read_bytes()
        write("velodyne", model, bytes([i]) + packet)
    kinds = ("legacy", "rng15_rfl8_nir8", "rng15_rfl8_nir8_dual", "rng19_rfl8_sig16_nir16",
             "rng19_rfl8_sig16_nir16_dual", "fusa_rng15_rfl8_nir8_dual")
    for i, kind in enumerate(kinds):
        payloads = udp_payloads((PACKETS / f"ouster_{kind}.pcap").read_bytes())
        write("ouster", kind, bytes([i]) + b"".join(payloads))


def texts():
    write("trajectory", "tum", "# stamp x y z qx qy qz qw\n1600000000.1 1 2 0.5 0 0 0.6 0.8\n"
          "1600000000.2 1.5 2 0.5 0 0 0 1\r\n1600000000.3\t2 nan 0.5 0 0 0 1\n")
    write("trajectory", "total_station", "1.0 1 2 3 0 0 0 0\n2.0 1 2 4 0 0 0 0\n")
    write("trajectory", "kitti", "1 0 0 0 0 1 0 0 0 0 1 0\n"
          "0.6 -0.8 0 1.5 0.8 0.6 0 2e-1 0 0 1 0\n")
    write("trajectory", "euroc", "#timestamp [ns],px,py,pz,qw,qx,qy,qz,vx\n"
          "1600000000100000000,1,2,0.5,1,0,0,0,0.1\n1600000000200000000, 1.5, 2, 0.5, 0.8, 0, 0, 0.6, 0\n")
    write("stamps", "seconds", "# of a car\n0.0\n1.036224e-01\n1317042000.103499889\n")
    write("stamps", "dates", "2011-09-26 13:02:25.594360375\n2011-09-26T13:02:25.7Z\n")
    write("stamps", "whole", "1600000000100000000\n1600000000200000000\n")
    write("config", "settings", "window: {segments: 3}\n---8<---\n"
          "solver.kind=gauss_newton,input.topics=[/a, /b],map.radius_m=80")
    write("config", "extrinsics", "sensor:\n  T_body_lidar:\n    - {translation_m: [0, 0, 1]}\n"
          "    - {rotation: [0, 0, 0.6, 0.8]}\n"
          "    - {matrix: [[1, 0, 0, 1], [0, 1, 0, 2], [0, 0, 1, 3]]}\n")


def scans():
    # Options are the first bytes, a scan six at least; zeros are scans without faults.
    write("segmenter", "plain", bytes(3 + 6 * 30))
    write("odometry", "plain", bytes(13 + 6 * 12))
    turns = b"".join(bytes([i % 16 + 16 * (i % 3), 0, 10, i % 11, 3, 0, 0, 0]) for i in range(24))
    write("segmenter", "every_fault", bytes(3) + turns)
    write("odometry", "every_fault", bytes(13) + turns)
    write("odometry", "every_fault_four_threads", bytes([1] + [0] * 12) + turns)
    write("odometry", "every_option", bytes([1] * 13) + bytes([0, 0, 10, 0, 0, 0]) * 12)


if __name__ == "__main__":
    messages()
    bags()
    packets()
    texts()
    scans()
