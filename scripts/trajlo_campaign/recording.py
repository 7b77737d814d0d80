# SPDX-License-Identifier: MIT
"""What recordings of all formats have in common for those who damage them."""
PERIOD_NS = 100_000_000


class Recording:
    """Scans that can be edited.

    clocks_ns: what the clocks of the recording add to the true time; faults add to them.
    gone: scans (of the first LiDAR) of which nothing usable is left, or that cannot be placed.
    """

    def __init__(self, clock_ns):
        self.clocks_ns = [clock_ns]
        self.gone = set()

    def shift(self, indices, shift_ns):
        """Moves the stamps of these scans."""
        for index in indices:
            self.set_stamp(index, self.stamp(index) + shift_ns)

    def edit(self, index, change):
        """Replaces the points of a scan by change(points)."""
        self.set_points(index, change(self.points(index)))
