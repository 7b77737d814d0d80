# SPDX-License-Identifier: MIT
import warnings
from typing import Any, Callable, Dict, List, Optional, Tuple

import numpy

from . import _trajlo
from ._config import ConfigNames, Options, make_config
from ._trajlo import Scan, Trajectory, Window
from .errors import LostWarning, PartialInputWarning, TrajloWarning

WindowCallback = Callable[[Dict[str, Any]], object]
SolvedCallback = Callable[[Window], object]
PoseCallback = Callable[[int, numpy.ndarray, numpy.ndarray], object]


class Odometry:
    """LiDAR odometry: scans go in, a trajectory in continuous time and a map come out.

    The world frame is the body frame at the first point. The body is LiDAR 0, or whatever
    `sensor.T_body_lidar` says. The result is that of trajlo_run, to the last bit, and does not
    depend on the number of threads.

    options     a dict with the keys of the YAML files, nested or with dots:
                {"window.segments": 3} or {"window": {"segments": 3}}; see trajlo.options()
    config      a YAML file or the name of a configuration (trajlo.configs()), or several, which
                override each other; options come last
    on_window   called with every window, as a dict with the columns of `windows`
    on_solved   called with every window as it was solved, a Window: all factors, residuals and
                weights, H and g, and solve() with other weights; takes a few ms a window
    on_pose     called with every pose that is final: t_ns, T_world_body (4, 4), and the covariance
                (6, 6) of its right perturbation [rho; theta], m², m rad, rad²
    covariance  keep these covariances

    Computing releases the GIL. Another thread that reads meanwhile waits until that call has
    returned, or calls a callback; one that adds a scan gets a StateError. An exception of a
    callback is raised by the call that it interrupts, after the scan has been processed. An
    odometry cannot be pickled or copied; what it gives can. Raises ConfigError.
    """

    def __init__(self, options: Optional[Options] = None, *,
                 config: Optional[ConfigNames] = None,
                 on_window: Optional[WindowCallback] = None,
                 on_solved: Optional[SolvedCallback] = None,
                 on_pose: Optional[PoseCallback] = None,
                 covariance: bool = False):
        self._config = make_config(options, config)
        self._session = _trajlo.Session(self._config, on_window, on_solved, on_pose,
                                        covariance)
        self._told_lost = False
        self._told_without_times = False

    def add(self, scan: Any, times_s: Any = None, *, times_ns: Any = None,
            stamp_ns: Optional[int] = None, intensities: Any = None, lidar: int = 0) -> None:
        """Adds a Scan, or the arrays of one: see Scan. Scans of a LiDAR come in the order of time.

        Raises InputError for arrays that do not fit, ConfigError for a LiDAR that
        sensor.T_body_lidar does not place, StateError after finish(). Warns with LostWarning, and
        with TrajloWarning about arrays without times, and about times of another unit: of sweeps
        much shorter or longer than the time between stamps; unless input.point_time is none.
        """
        if not isinstance(scan, Scan):
            if stamp_ns is None:
                raise TypeError("stamp_ns is missing: when the scan was measured, in nanoseconds")
            scan = Scan(scan, times_s, times_ns=times_ns, stamp_ns=stamp_ns,
                        intensities=intensities, lidar=lidar)
            self._warn_without_times(scan)
        elif not (times_s is None and times_ns is None and stamp_ns is None
                  and intensities is None and lidar == 0):
            raise TypeError("a Scan has its own times, stamp, intensities and LiDAR")
        self._session.add(scan)
        self._warn_about_times(at_end=False)
        self._warn_if_lost()

    def finish(self) -> None:
        """Processes what is left; all poses are final then, and no more scans are taken.

        Raises InputError if no scan was added, or no point could be used. Warns with LostWarning, with
        PartialInputWarning if much was dropped, and with TrajloWarning about odd stamps, and about
        poses that the points do not hold, as trajlo_run does; `windows` has their flags.
        """
        self._session.finish()
        self._warn_about_times(at_end=True)
        self._warn_if_lost()
        for remark in self._session.remarks():
            warnings.warn(remark, TrajloWarning, stacklevel=2)
        shortcomings = self._session.shortcomings()
        if shortcomings:
            warnings.warn(shortcomings, PartialInputWarning, stacklevel=2)

    def _warn_without_times(self, scan: Scan) -> None:
        if (self._told_without_times or scan.has_point_times or len(scan) == 0
                or not self._session.expects_times(scan.lidar)):
            return
        self._told_without_times = True
        warnings.warn("points have no times of their own: right for motion-corrected scans only, "
                      "others blur with every turn (the option input.point_time=none says that "
                      "they are corrected)", TrajloWarning, stacklevel=3)

    def _warn_about_times(self, at_end: bool) -> None:
        doubt = self._session.take_doubt_of_times(at_end)
        if doubt:
            warnings.warn(doubt, TrajloWarning, stacklevel=3)

    def _warn_if_lost(self) -> None:
        t_ns = self._session.lost_at_ns()
        if t_ns is None or self._told_lost:
            return
        self._told_lost = True
        seconds = f"{t_ns // 10**9}.{t_ns % 10**9:09d}"
        warnings.warn(f"the estimator got lost at {seconds} s; poses from there on are not to be "
                      "trusted (windows shows what happened)", LostWarning, stacklevel=3)

    def __reduce_ex__(self, protocol: Any) -> Any:
        raise TypeError("an Odometry cannot be pickled or copied: it is a computation; its "
                        "trajectory, windows, map and covariances can")

    @property
    def trajectory(self) -> Trajectory:
        """The poses that are final, T_world_body: all of them after finish(). A copy."""
        return self._session.trajectory()

    @property
    def windows(self) -> Dict[str, numpy.ndarray]:
        """The columns of windows.csv, (W,) each, and begin_ns and end_ns, which are exact."""
        return self._session.windows()

    @property
    def map(self) -> numpy.ndarray:
        """(M, 3) float64: the finest level of the local map, metres, world frame. A copy."""
        return self._session.map()

    @property
    def covariances(self) -> numpy.ndarray:
        """(N, 6, 6) float64, one for each pose of the trajectory: [rho; theta] as for on_pose."""
        return self._session.covariances()

    @property
    def point_counts(self) -> Dict[str, int]:
        """What became of the points: received, kept, and those that were dropped, by reason."""
        return self._session.point_counts()

    @property
    def rig(self) -> List[Tuple[numpy.ndarray, float]]:
        """For each LiDAR of sensor.T_body_lidar: where it was found to be by now, (4, 4), and the
        seconds that are added to its times."""
        return self._session.rig()

    @property
    def lost_at_ns(self) -> Optional[int]:
        """When the estimator got lost, if it did."""
        return self._session.lost_at_ns()

    @property
    def is_finished(self) -> bool:
        """Whether finish() has been called."""
        return self._session.is_finished

    @property
    def config(self) -> str:
        """All options as they are, as YAML with explanations: config.yaml of a run."""
        return self._config.dump()
