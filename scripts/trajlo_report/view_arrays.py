# SPDX-License-Identifier: MIT
"""Arrays in a page: small, and quick to read back. view/arrays.js is the other half."""
import base64
import zlib

import numpy as np


def planes(values):
    """First the lowest byte of all values, then the next: equal bytes stand side by side."""
    size = values.dtype.itemsize
    return np.ascontiguousarray(values).view(np.uint8).reshape(-1, size).T.tobytes()


def differences(values):
    """Of neighbours, modulo 2^16: neighbours in space are small numbers."""
    return np.diff(values, prepend=values.dtype.type(0)).astype(np.uint16)


class Arrays:
    """Collects named arrays; `index` says what they are, `text` holds them all."""

    def __init__(self):
        self.index = {}
        self._parts = []

    def _add(self, name, kind, length, data):
        self.index[name] = {"kind": kind, "length": int(length),
                            "offset": sum(map(len, self._parts)), "bytes": len(data)}
        self._parts.append(data)

    def add_positions(self, name, values):
        """16-bit numbers, best in an order in which neighbours are alike."""
        values = np.asarray(values, np.uint16)
        self._add(name, "uint16 differences", len(values), planes(differences(values)))

    def add_bytes(self, name, values):
        values = np.asarray(values, np.uint8)
        self._add(name, "uint8", len(values), values.tobytes())

    def add_floats(self, name, values):
        values = np.ascontiguousarray(values, "<f4").ravel()
        self._add(name, "float32", len(values), planes(values))

    def text(self):
        return base64.b64encode(zlib.compress(b"".join(self._parts), 9)).decode()


def morton(grid):
    """Numbers that put three 16-bit coordinates in an order in which neighbours are near."""
    code = np.zeros(len(grid), np.uint64)
    for axis in range(3):
        x = grid[:, axis].astype(np.uint64)
        for shift, mask in ((32, 0x1F00000000FFFF), (16, 0x1F0000FF0000FF),
                            (8, 0x100F00F00F00F00F), (4, 0x10C30C30C30C30C3),
                            (2, 0x1249249249249249)):
            x = (x | (x << np.uint64(shift))) & np.uint64(mask)
        code |= x << np.uint64(axis)
    return code
