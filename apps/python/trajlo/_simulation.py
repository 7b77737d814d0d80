# SPDX-License-Identifier: MIT
from typing import Any, Dict, Iterator, List, Mapping, Optional

import numpy

from . import _trajlo
from ._trajlo import Scan, Trajectory


def scenarios() -> Dict[str, str]:
    """What can be simulated: {name: description}."""
    return _trajlo.scenarios()


class Simulation:
    """A simulated recording; each iteration gives the same scans. See simulate()."""

    def __init__(self, simulator: _trajlo.Simulator, scenario: str, threads: int):
        self._simulator = simulator
        self._scenario = scenario
        self._threads = threads

    def __iter__(self) -> Iterator[Scan]:
        return _trajlo.Stream(self._simulator, self._threads)

    def __len__(self) -> int:
        """The sweeps of all LiDARs; faults may drop or repeat some."""
        return self._simulator.scan_count()

    @property
    def truth(self) -> Trajectory:
        """The exact poses T_world_body at 1 kHz; the world is the frame of the scene, z up."""
        return self._simulator.truth()

    @property
    def T_body_lidar(self) -> List[numpy.ndarray]:
        """Where each LiDAR sits in the body frame, (4, 4)."""
        return self._simulator.T_body_lidar()

    @property
    def options(self) -> Dict[str, Any]:
        """The options that an Odometry needs for this rig: {"sensor.T_body_lidar": [...]}."""
        return {"sensor.T_body_lidar": [
            {"translation_m": pose[4:], "rotation": pose[:4]} for pose in self._simulator.rig()]}

    @property
    def parameters(self) -> Dict[str, str]:
        """All parameters of the scenario with their values, as text."""
        return self._simulator.parameters()

    def __repr__(self) -> str:
        return f"<trajlo.Simulation of {self._scenario}, {len(self)} scans>"


def simulate(scenario: str, *, seed: Optional[int] = None, duration_s: Optional[float] = None,
             parameters: Optional[Mapping[str, Any]] = None, threads: int = 0) -> Simulation:
    """Simulates a recording with exact truth: the scans of trajlo_simulate.

    scenario    see scenarios()
    seed        of noise, shaking, and details of the scene; None keeps the scenario's own
    duration_s  seconds
    parameters  others to change: {"motion.speed_mps": 5, "lidar.range_sigma_m": 0.05}
    threads     0 for all processors; the scans do not depend on it

    Raises ConfigError for what cannot be simulated.
    """
    texts = [(key, _text(value)) for key, value in (parameters or {}).items()]
    return Simulation(_trajlo.Simulator(scenario, seed, duration_s, texts), scenario, threads)


def _text(value: Any) -> str:
    if isinstance(value, (bool, numpy.bool_)):
        return "true" if value else "false"
    if isinstance(value, (list, tuple, numpy.ndarray)):
        return ",".join(str(item) for item in value)
    return str(value)
