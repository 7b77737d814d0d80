# SPDX-License-Identifier: MIT
"""A folder of scans, with a file of their stamps, that faults can edit."""
import decimal
import pathlib

import numpy as np

from trajlo_campaign import point_arrays
from trajlo_campaign.recording import Recording


def seconds(stamp_ns):
    return f"{decimal.Decimal(stamp_ns).scaleb(-9):.9f}"


class ScanFolder(Recording):
    """The scans of one LiDAR. Files that are shared with other copies are replaced, not changed."""

    def __init__(self, folder, clock_ns=0):
        super().__init__(clock_ns)
        folder = pathlib.Path(folder)
        self.stamps_file = next(folder / name for name in ("timestamps.txt", "times.txt")
                                if (folder / name).is_file())
        self.scans_folder = next(folder / name for name in ("scans", "velodyne")
                                 if (folder / name).is_dir())
        self.files = sorted(self.scans_folder.iterdir())
        self.lines = self.stamps_file.read_text().splitlines()

    def __len__(self):
        return len(self.files)

    def stamp(self, index):
        return int(decimal.Decimal(self.lines[index]).scaleb(9))

    def set_stamp(self, index, stamp_ns):
        self.lines[index] = seconds(stamp_ns)

    def read(self, index):
        path = self.files[index]
        return path.read_bytes() if path.is_file() else b""

    def write(self, index, data):
        self.files[index].unlink(missing_ok=True)
        self.files[index].write_bytes(data)

    def points(self, index):
        """The points of a scan; nothing where another fault has left no readable file."""
        data = self.read(index)
        if self.files[index].suffix == ".bin":
            return np.frombuffer(data, point_arrays.KITTI, len(data) // 16).copy()
        try:
            return point_arrays.read_pcd(data)[1]
        except (ValueError, KeyError, IndexError):
            return None

    def set_points(self, index, points):
        if self.files[index].suffix == ".bin":
            self.write(index, points.tobytes())
        else:
            header = point_arrays.read_pcd(self.read(index))[0]
            self.write(index, point_arrays.write_pcd(header, points))

    def edit(self, index, change):
        if self.points(index) is not None:
            super().edit(index, change)

    def rename_time_field(self):
        """The points' times get a name that nobody knows."""
        for index in range(len(self)):
            data = self.read(index)
            head, rest = data[:400], data[400:]
            self.write(index, head.replace(b"intensity time\n", b"intensity xyzt\n") + rest)

    def save(self):
        self.stamps_file.unlink(missing_ok=True)
        kept = (line for line in self.lines if line is not None)
        self.stamps_file.write_text("".join(f"{line}\n" for line in kept))
