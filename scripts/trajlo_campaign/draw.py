# SPDX-License-Identifier: MIT
"""What a run is: its scene, its format and its faults. All of it follows from seed and number."""
import dataclasses

import numpy as np

from trajlo_campaign import file_faults, point_faults, scenes, simulator_faults, stamp_faults

# In the order in which they are applied. The formats are those that a family can damage.
EDITABLE = ("pcd", "bag", "mcap")
FAMILIES = {
    "simulator": (simulator_faults.FAULTS, scenes.FORMATS),
    "stamps": (stamp_faults.FAULTS, EDITABLE),
    "points": (point_faults.FAULTS, EDITABLE),
    "folder": (file_faults.FOLDER_FAULTS, ("pcd",)),
    "bytes": (file_faults.BYTE_FAULTS, ("bag", "lz4", "bz2", "mcap")),
}
SHARES = {"pcd": 4, "bag": 2.5, "mcap": 1.5, "lz4": 1, "bz2": 1}
MOST_FAULTS = 4


@dataclasses.dataclass(frozen=True)
class Fault:
    family: str
    function: object
    lidar: int
    key: tuple  # of its random numbers

    @property
    def name(self):
        return self.function.__name__

    def rng(self):
        return np.random.default_rng(self.key)


@dataclasses.dataclass(frozen=True)
class Drawn:
    number: int
    scene: scenes.Scene
    kind: str
    faults: tuple

    def of(self, family):
        return [fault for fault in self.faults if fault.family == family]


def draw_format(scene, rng):
    weights = np.array([SHARES[kind] for kind in scene.formats], float)
    return str(rng.choice(scene.formats, p=weights / weights.sum()))


def draw(seed, number):
    """The run with this number."""
    rng = np.random.default_rng((seed, number))
    scene = scenes.SCENES[int(rng.integers(len(scenes.SCENES)))]
    kind = draw_format(scene, rng)
    families = [name for name, (_, kinds) in FAMILIES.items() if kind in kinds]
    chosen = {}
    for index in range(int(rng.integers(1, MOST_FAULTS + 1))):
        family = str(rng.choice(families))
        functions = FAMILIES[family][0]
        function = functions[int(rng.integers(len(functions)))]
        lidar = int(rng.integers(scene.lidars))
        chosen.setdefault(function, Fault(family, function, lidar, (seed, number, index)))
    order = list(FAMILIES)
    faults = sorted(chosen.values(), key=lambda fault: order.index(fault.family))
    return Drawn(number, scene, kind, tuple(faults))
