# SPDX-License-Identifier: MIT
"""ROS 1 messages in a bag or in mcap, that faults can edit in place."""
import pathlib
import struct

from trajlo_campaign import point_arrays
from trajlo_campaign.recording import Recording

CHUNK, CONNECTION, MESSAGE = 5, 7, 2
MAGIC = b"\x89MCAP0\r\n"


def bag_records(data, begin, end):
    """(header, begin of the data, its length) of each record between two places of a bag."""
    at = begin
    while at < end:
        length = struct.unpack_from("<I", data, at)[0]
        header, place = {}, at + 4
        while place < at + 4 + length:
            size = struct.unpack_from("<I", data, place)[0]
            name, _, value = bytes(data[place + 4:place + 4 + size]).partition(b"=")
            header[name.decode()] = value
            place += 4 + size
        size = struct.unpack_from("<I", data, place)[0]
        yield header, place + 4, size
        at = place + 4 + size


def described(data, begin, size):
    """The fields in a connection's data: type, definition."""
    fields, at = {}, begin
    while at < begin + size:
        length = struct.unpack_from("<I", data, at)[0]
        name, _, value = bytes(data[at + 4:at + 4 + length]).partition(b"=")
        fields[name.decode()] = value
        at += 4 + length
    return fields


def bag_messages(data):
    """Connections {number: (topic, type, definition)} of an uncompressed bag, and its messages
    (connection, time of recording in ns, begin, length)."""
    connections, messages = {}, []
    for header, begin, size in bag_records(data, len(b"#ROSBAG V2.0\n"), len(data)):
        if header["op"][0] != CHUNK:
            continue
        for inner, start, length in bag_records(data, begin, begin + size):
            number = struct.unpack("<I", inner["conn"])[0]
            if inner["op"][0] == CONNECTION:
                fields = described(data, start, length)
                connections[number] = (inner["topic"].decode(), fields["type"].decode(),
                                       fields["message_definition"])
            elif inner["op"][0] == MESSAGE:
                seconds, nanoseconds = struct.unpack("<II", inner["time"])
                messages.append((number, seconds * 1_000_000_000 + nanoseconds, start, length))
    return connections, messages


def text(value):
    value = value if isinstance(value, bytes) else value.encode()
    return struct.pack("<I", len(value)) + value


def mcap_record(opcode, content):
    return struct.pack("<BQ", opcode, len(content)) + content


def bag_to_mcap(bag, mcap, messages_in_chunk=40):
    """The messages of an uncompressed bag in chunks of mcap, without an index."""
    data = bytearray(pathlib.Path(bag).read_bytes())
    connections, messages = bag_messages(data)
    with pathlib.Path(mcap).open("wb") as file:
        file.write(MAGIC + mcap_record(1, text("ros1") + text("trajlo_campaign")))
        known = b""
        for number, (topic, kind, definition) in connections.items():
            known += mcap_record(3, struct.pack("<H", number + 1) + text(kind) + text("ros1msg")
                                 + text(definition))
            known += mcap_record(4, struct.pack("<HH", number, number + 1) + text(topic)
                                 + text("ros1") + struct.pack("<I", 0))
        file.write(known)
        for first in range(0, len(messages), messages_in_chunk):
            part = messages[first:first + messages_in_chunk]
            records = b"".join(
                mcap_record(5, struct.pack("<HIQQ", number, first + index, t_ns, t_ns)
                            + data[begin:begin + size])
                for index, (number, t_ns, begin, size) in enumerate(part))
            times = [message[1] for message in part]
            file.write(mcap_record(6, struct.pack("<QQQI", min(times), max(times), len(records), 0)
                                   + text("") + struct.pack("<Q", len(records)) + records))
        file.write(mcap_record(15, bytes(4)) + mcap_record(2, bytes(20)) + MAGIC)


def mcap_messages(data):
    """The same as bag_messages, of what bag_to_mcap writes."""
    connections, messages = {}, []
    schemas, at = {}, len(MAGIC)
    while at < len(data) - len(MAGIC):
        opcode, size = struct.unpack_from("<BQ", data, at)
        begin = at + 9
        if opcode == 3:
            end = point_arrays.skip_text(data, begin + 2)
            schemas[struct.unpack_from("<H", data, begin)[0]] = bytes(data[begin + 6:end]).decode()
        elif opcode == 4:
            number, schema = struct.unpack_from("<HH", data, begin)
            end = point_arrays.skip_text(data, begin + 4)
            connections[number] = (bytes(data[begin + 8:end]).decode(), schemas[schema], b"")
        elif opcode == 6:
            at = begin + 8 + 8 + 8 + 4 + 4 + 8  # its messages follow
            continue
        elif opcode == 5:
            number, _, t_ns, _ = struct.unpack_from("<HIQQ", data, begin)
            messages.append((number, t_ns, begin + 22, size - 22))
        at = begin + size
    return connections, messages


class MessageFile(Recording):
    """The scans on one topic of a bag or mcap without compression. Scans keep their length."""

    def __init__(self, path, data, messages, view, clock_ns):
        super().__init__(clock_ns)
        self.path, self.data, self.messages, self.view = path, data, messages, view

    def __len__(self):
        return len(self.messages)

    def message(self, index):
        begin, size = self.messages[index]
        return memoryview(self.data)[begin:begin + size]

    def stamp(self, index):
        return point_arrays.stamp_of(self.message(index))

    def set_stamp(self, index, stamp_ns):
        point_arrays.set_stamp(self.message(index), stamp_ns)

    def points(self, index):
        return self.view(self.message(index)).copy()

    def set_points(self, index, points):
        self.view(self.message(index))[:] = points

    def save(self):
        self.path.unlink()
        self.path.write_bytes(self.data)


def open_messages(path, clock_ns=0):
    """One for each topic with points; they share the bytes of the file."""
    path = pathlib.Path(path)
    data = bytearray(path.read_bytes())
    find = mcap_messages if path.suffix == ".mcap" else bag_messages
    connections, messages = find(data)
    clouds = sorted((topic, number, kind) for number, (topic, kind, _) in connections.items()
                    if kind.endswith(("/PointCloud2", "/CustomMsg")))
    return [MessageFile(path, data,
                        [(begin, size) for number, _, begin, size in messages if number == wanted],
                        point_arrays.custom_points if kind.endswith("/CustomMsg")
                        else point_arrays.cloud_points, clock_ns)
            for _, wanted, kind in clouds]
