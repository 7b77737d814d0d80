# SPDX-License-Identifier: MIT
"""LiDAR-only odometry with a continuous-time trajectory.

    import trajlo
    odometry = trajlo.Odometry({"segmenter.interval_s": 0.03})
    for scan in trajlo.open("flight.bag"):
        odometry.add(scan)          # or odometry.add(points, times_s, stamp_ns=...)
    odometry.finish()
    odometry.trajectory.save_tum("trajectory.tum")

Units and frames are in the names: T_world_body maps coordinates of the body frame to the world
frame, metres; times are nanoseconds (_ns) or seconds (_s). Arrays are numpy's.
"""

from . import _build, _processor

_processor.require(_build.ARCH)

from . import errors
from ._config import configs, options
from ._evaluation import evaluate, read_trajectory
from ._odometry import Odometry
from ._recording import Recording, open
from ._simulation import Simulation, scenarios, simulate
from ._trajlo import Scan, Trajectory, Window
from ._trajlo import version as __version__  # noqa: F401
from .errors import (ConfigError, Error, EstimatorError, EvaluationError, InputError, LostWarning,
                     OutputError, PartialInputWarning, StateError, TrajloWarning, UsageError)

for _name in (Scan, Trajectory, Window):
    _name.__module__ = __name__
del _name

__all__ = [
    "Odometry", "Scan", "Trajectory", "Window", "Recording", "Simulation",
    "open", "simulate", "evaluate", "read_trajectory", "options", "configs", "scenarios",
    "errors", "Error", "ConfigError", "UsageError", "InputError", "EvaluationError", "OutputError",
    "StateError", "EstimatorError", "TrajloWarning", "PartialInputWarning", "LostWarning",
]
