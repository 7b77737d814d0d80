// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/numpy.h>

#include <cstdint>
#include <exception>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/python/module/exclusive.h"
#include "apps/python/module/flagged_trajectory.h"
#include "apps/python/module/sweep_watch.h"
#include "core/config/config.h"
#include "core/odometry/odometry.h"

namespace trajlo::python {

namespace py = pybind11;

/// What a user of the module asks for, besides the options.
struct SessionRequest {
  py::object on_window;     ///< Called with a dict of one window; may be None.
  py::object on_solved;     ///< Called with an InspectedWindow; may be None.
  py::object on_pose;       ///< Called with t_ns, (4, 4) and (6, 6); may be None.
  bool covariance = false;  ///< Keep the covariances.
};

/// An Odometry that computes without the GIL, keeps its windows, and says so when it is misused.
/// Members are called with the GIL held.
class OdometrySession {
 public:
  OdometrySession(const RunConfig& config, const SessionRequest& request);

  /// Throws StateError after Finish() or a failure, ConfigError for a LiDAR whose place is unknown,
  /// EstimatorError, and what a callback throws: after the scan has been processed to its end.
  void Add(const LidarScan& scan);
  /// Throws also InputError if no point could be used.
  void Finish();

  /// False where the options say that scans of this LiDAR are motion-corrected.
  bool ExpectsTimes(std::int64_t lidar) const {
    return config_.input.use_point_times.Of(static_cast<std::size_t>(lidar < 0 ? 0 : lidar));
  }
  bool is_finished() const { return is_finished_; }
  /// These wait while another thread computes, unless that is in a callback.
  const Odometry& odometry() const;
  /// Its flags are those of flags.csv.
  FlaggedTrajectory Poses() const;
  py::dict Windows() const;
  py::array_t<double> Covariances() const;
  py::array_t<double> MapPoints() const;
  py::dict PointCounts() const;
  /// Where each LiDAR was found to be, (4, 4), and what is added to its times.
  std::vector<std::pair<py::array_t<double>, double>> Rig() const;
  /// Sentences about odd stamps and doubtful poses, and about a part of the input that is missing.
  std::vector<std::string> Remarks() const;
  std::string Shortcomings() const;
  /// A sentence about times of points that do not fit the stamps, once; empty if there is none.
  std::string TakeDoubtOfTimes(bool at_end) { return sweeps_.TakeDoubt(at_end); }

 private:
  void RequireOpen() const;
  void RequireExtrinsicOf(int lidar) const;
  template <typename Work>
  void Compute(const Work& work);
  /// What went wrong in Compute().
  void Rethrow();
  template <typename Callback>
  void Call(const Callback& callback);

  const RunConfig config_;
  SessionRequest request_;
  Exclusive exclusive_;
  std::vector<WindowStatistics> windows_;
  std::vector<Matrix6d> covariances_;
  std::exception_ptr thrown_by_callback_;
  std::string failure_;
  bool is_finished_ = false;
  int newest_lidar_ = -1;                                ///< The largest number so far.
  std::int64_t first_stamp_ns_ = 0, last_stamp_ns_ = 0;  ///< The earliest and the latest so far.
  std::int64_t scans_ = 0;
  SweepWatch sweeps_;
  Odometry odometry_;
};

}  // namespace trajlo::python
