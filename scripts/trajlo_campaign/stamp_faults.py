# SPDX-License-Identifier: MIT
"""Damage to the stamps of scans. Each fault changes a recording and says what it did."""
import statistics

from trajlo_campaign.recording import PERIOD_NS

STEPS_S = (-86400.0, -3600.0, -30.0, -2.0, -0.5, 0.35, 0.5, 2.0, 30.0, 3600.0, 86400.0)


def one(recording, rng):
    return int(rng.integers(len(recording)))


def step_ns(rng):
    return int(rng.choice(STEPS_S) * 1e9)


def wrong_stamp(recording, rng):
    """One to three stamps are off, each by its own."""
    said = []
    for _ in range(int(rng.integers(1, 4))):
        index, shift_ns = one(recording, rng), step_ns(rng)
        recording.shift([index], shift_ns)
        said.append(f"{index} by {shift_ns / 1e9:g} s")
    return f"stamps off: {', '.join(said)}"


def zero_stamps(recording, rng):
    """A clock that is set only after some scans."""
    count = int(rng.integers(1, 6))
    recording.clocks_ns.append(recording.clocks_ns[0] - recording.stamp(0))
    for index in range(count):
        recording.set_stamp(index, index * PERIOD_NS if rng.random() < 0.5 else 0)
    return f"the first {count} stamps near 0"


def clock_step(recording, rng):
    """The clock steps, and stays so."""
    index, shift_ns = int(rng.integers(1, len(recording))), step_ns(rng)
    recording.shift(range(index, len(recording)), shift_ns)
    recording.clocks_ns.append(recording.clocks_ns[0] + shift_ns)
    return f"clock steps by {shift_ns / 1e9:g} s at scan {index}"


def clock_leaps_and_returns(recording, rng):
    """The clock is off for a while."""
    first = int(rng.integers(0, len(recording) - 5))
    count, shift_ns = int(rng.integers(2, 15)), step_ns(rng)
    recording.shift(range(first, min(first + count, len(recording))), shift_ns)
    recording.clocks_ns.append(recording.clocks_ns[0] + shift_ns)
    return f"clock off by {shift_ns / 1e9:g} s for {count} scans from {first}"


def equal_stamps(recording, rng):
    """The stamp stands still for some scans."""
    first = int(rng.integers(0, len(recording) - 5))
    count = int(rng.integers(2, 12))
    for index in range(first, min(first + count, len(recording))):
        recording.set_stamp(index, recording.stamp(first))
    return f"{count} equal stamps from {first}"


def swapped_stamps(recording, rng):
    """Neighbours have each other's stamp: points are not when they seem to be."""
    said = []
    for _ in range(int(rng.integers(1, 5))):
        index = int(rng.integers(len(recording) - 1))
        here, there = recording.stamp(index), recording.stamp(index + 1)
        recording.set_stamp(index, there)
        recording.set_stamp(index + 1, here)
        said.append(str(index))
    return f"stamps swapped with the next: {', '.join(said)}"


def reversed_stamps(recording, _):
    """All stamps run backwards."""
    stamps = [recording.stamp(index) for index in range(len(recording))]
    for index, stamp in enumerate(reversed(stamps)):
        recording.set_stamp(index, stamp)
    return "stamps reversed"


def slow_clock(recording, rng):
    """The clock runs at another rate, up to one in a hundred."""
    rate = float(rng.uniform(-0.01, 0.01))
    stamps = [recording.stamp(index) for index in range(len(recording))]
    # Another fault may have spoilt the first ones.
    middle = statistics.median_low(stamps)
    for index, stamp in enumerate(stamps):
        recording.set_stamp(index, max(0, middle + round((stamp - middle) * (1 + rate))))
    return f"clock {100 * rate:.2f} % fast"


FAULTS = (wrong_stamp, wrong_stamp, zero_stamps, clock_step, clock_step, clock_leaps_and_returns,
          equal_stamps, swapped_stamps, slow_clock, reversed_stamps)
