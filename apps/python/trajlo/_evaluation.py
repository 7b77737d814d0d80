# SPDX-License-Identifier: MIT
import csv
import decimal
import json
import os
from pathlib import Path
import warnings
from typing import Any, Dict, List, Optional, Union

import numpy

from . import _trajlo
from ._trajlo import Trajectory
from .errors import TrajloWarning

Source = Union[Trajectory, str, os.PathLike]


def read_trajectory(path: Union[str, os.PathLike], *, format: str = "auto",
                    times: Union[str, os.PathLike, None] = None) -> Trajectory:
    """Reads a trajectory in TUM's, KITTI's or EuRoC's format.

    format  auto, tum, kitti or euroc
    times   a file of stamps, one for each line of a KITTI file

    Of several poses with the same stamp the first is taken. Its `flags` are those of the flags.csv
    that trajlo_run wrote beside it, and None where there is none of these times. Raises InputError.
    """
    poses = _trajlo.Poses.from_file(path, format, times, "first", "interpolate")
    for text in poses.warnings:
        warnings.warn(text, TrajloWarning, stacklevel=2)
    trajectory = poses.trajectory()
    flags = _flags_beside(path, trajectory.times_ns)
    return trajectory if flags is None else poses.trajectory(flags)


def _flags_beside(path: Union[str, os.PathLike], times_ns: numpy.ndarray) -> Optional[List[int]]:
    """The column of flags.csv in the folder of a trajectory, if it is of these poses."""
    try:
        with (Path(os.fsdecode(path)).parent / "flags.csv").open(newline="") as file:
            rows = [(row["t_s"], int(row["flags"])) for row in csv.DictReader(file)]
        found_ns = [int(decimal.Decimal(t_s).scaleb(9)) for t_s, _ in rows]
    except (OSError, ValueError, TypeError, KeyError, ArithmeticError, csv.Error):
        return None  # Another file of that name, or none.
    return [bits for _, bits in rows] if found_ns == times_ns.tolist() else None


def evaluate(estimate: Source, truth: Source, *,
             association: str = "interpolate", max_gap_s: float = 0.0,
             max_time_difference_s: float = 0.01,
             time_offset_s: float = 0.0, estimate_time_offset: bool = False,
             time_offset_reach_s: float = 0.5,
             alignment: str = "se3", align_first: str = "",
             T_body_truth: Any = None, truth_orientation: str = "auto",
             rpe: str = "1m,10m,1s", rpe_all_pairs: bool = False,
             rpe_along_truth: bool = False, rpe_tolerance: float = 0.1,
             diverged_percent: float = 10.0, diverged_m: float = 0.0,
             min_completeness: float = 0.5, repeated_stamps: str = "auto",
             format: str = "auto", truth_format: str = "auto",
             times: Optional[Union[str, os.PathLike]] = None) -> Dict[str, Any]:
    """How far an estimate is from the truth: the numbers of trajlo_evaluate.

    estimate, truth   a Trajectory or a file in TUM's, KITTI's or EuRoC's format
    T_body_truth      (4, 4): the frame that the truth describes, in the body frame
    everything else   as the flag of trajlo_evaluate with that name; its --help explains them

    Returns the entry of evaluation.json, such as result["ate"]["translation_m"]["rmse"] (metres,
    degrees), result["rpe"], result["kitti"], result["diverged"]; None for what was not computed.
    Beside it:
      warnings  sentences; each is also given to Python's warnings, as TrajloWarning
      errors    arrays over the pairs: t_ns (N,), T_world_body (N, 4, 4) after the alignment,
                T_world_truth (N, 4, 4), translation_m (N,), rotation_deg (N,) or (0,)

    Raises InputError, EvaluationError, and UsageError.
    """
    arguments = dict(locals())

    def poses(source: Source, name: str, format: str) -> _trajlo.Poses:
        if isinstance(source, Trajectory):
            return _trajlo.Poses.from_trajectory(source, name)
        return _trajlo.Poses.from_file(source, format, times, repeated_stamps, association)

    text, errors = _trajlo.evaluate(
        poses(estimate, "estimate", format), poses(truth, "truth", truth_format), arguments)
    report = json.loads(text)
    for warning in report["warnings"]:
        warnings.warn(warning, TrajloWarning, stacklevel=2)
    return {**report["estimates"][0], "warnings": report["warnings"], "errors": errors}
