// SPDX-License-Identifier: MIT
#include "apps/python/module/odometry_session.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>
#include <utility>

#include "apps/python/module/arrays.h"
#include "apps/python/module/inspected_window.h"
#include "apps/python/module/window_table.h"
#include "core/comparison/forms/ceres_form_solver.h"
#include "core/io/format_text.h"
#include "core/report/flag_warnings.h"
#include "core/report/run_summary.h"

namespace trajlo::python {
namespace {

/// No LiDAR, nor a packet of one, is so fast: 100 ms told in another unit.
constexpr std::int64_t kShortest_ns = 200'000;

py::array_t<double> CovarianceArray(const Matrix6d& covariance) {
  py::array_t<double> array({6, 6});
  std::memcpy(array.mutable_data(), covariance.data(), sizeof(double) * 36);  // It is symmetric.
  return array;
}

}  // namespace

OdometrySession::OdometrySession(const RunConfig& config, const SessionRequest& request)
    : config_(config),
      request_(request),
      odometry_(config.odometry, MakeSolverFactory(config.ceres_form)) {
  odometry_.OnWindow([this](const WindowStatistics& window) {
    windows_.push_back(window);
    if (request_.on_window.is_none()) return;
    Call([&] { request_.on_window(WindowRow(window)); });
  });
  if (!request_.on_solved.is_none()) {
    const auto shared = std::make_shared<const RunConfig>(config);
    odometry_.OnSolvedWindow([](std::int64_t) { return true; },
                             [this, shared](std::int64_t index, const Window& window) {
                               InspectedWindow inspected(index, window, shared);
                               Call([&] { request_.on_solved(py::cast(std::move(inspected))); });
                             });
  }
  if (!request_.covariance && request_.on_pose.is_none()) return;
  odometry_.OnPose([this](const ControlPose& pose, const Matrix6d& covariance) {
    if (request_.covariance) covariances_.push_back(covariance);
    if (request_.on_pose.is_none()) return;
    Call([&] {
      request_.on_pose(pose.t_ns, PoseArray(pose.T_world_body), CovarianceArray(covariance));
    });
  });
}

/// What a callback throws must not cut through the estimator: it waits until that has returned.
template <typename Callback>
void OdometrySession::Call(const Callback& callback) {
  const py::gil_scoped_acquire acquire;
  if (thrown_by_callback_) return;
  const Exclusive::CallingBack calling_back(&exclusive_);
  try {
    callback();
  } catch (...) {
    thrown_by_callback_ = std::current_exception();
  }
}

template <typename Work>
void OdometrySession::Compute(const Work& work) {
  const Exclusive::Claim claim(&exclusive_);
  const py::gil_scoped_release release;
  try {
    work();
  } catch (const std::exception& error) {
    failure_ = std::string("the estimator failed: ") + error.what();
  }
}

void OdometrySession::Rethrow() {
  if (thrown_by_callback_) std::rethrow_exception(std::exchange(thrown_by_callback_, nullptr));
  if (!failure_.empty()) throw EstimatorError(failure_);
}

void OdometrySession::RequireOpen() const {
  if (is_finished_) {
    throw StateError("this odometry is finished; make a new one for more scans");
  }
  if (!failure_.empty()) throw StateError("this odometry cannot go on: " + failure_);
}

/// Taken to sit where another one sits, a LiDAR gives a wrong trajectory without any complaint.
void OdometrySession::RequireExtrinsicOf(int lidar) const {
  const auto known = static_cast<int>(config_.odometry.segmenter.T_body_lidar.size());
  if (lidar < std::max(known, 1)) return;
  throw ConfigError("sensor.T_body_lidar",
                    "has the poses of " + std::to_string(known) + " LiDARs, and a scan of LiDAR " +
                        std::to_string(lidar) +
                        " (counted from 0) came; give the pose of each in " +
                        "the body frame, in this order: {\"sensor.T_body_lidar\": "
                        "[{\"translation_m\": [x, y, z], \"rotation\": [qx, qy, qz, qw]}, ...]}");
}

void OdometrySession::Add(const LidarScan& scan) {
  RequireOpen();
  RequireExtrinsicOf(scan.lidar_id);
  newest_lidar_ = std::max(newest_lidar_, scan.lidar_id);
  first_stamp_ns_ = scans_ == 0 ? scan.stamp_ns : std::min(first_stamp_ns_, scan.stamp_ns);
  last_stamp_ns_ = scans_ == 0 ? scan.stamp_ns : std::max(last_stamp_ns_, scan.stamp_ns);
  ++scans_;
  if (ExpectsTimes(scan.lidar_id)) sweeps_.Note(scan);
  Compute([&] { odometry_.AddScan(scan); });
  Rethrow();
}

void OdometrySession::Finish() {
  RequireOpen();
  Compute([&] { odometry_.Finish(); });
  is_finished_ = true;
  // They may hold what holds this object, which would keep both for ever.
  request_.on_window = request_.on_solved = request_.on_pose = py::none();
  Rethrow();
  if (scans_ == 0) throw DataError("no scan was added before finish()");
  const trajlo::PointCounts counts = odometry_.point_counts();
  if (!odometry_.trajectory().empty() && counts.Kept() > 0) return;
  throw DataError("none of the " + std::to_string(counts.received) +
                  " points can be used; see point_counts, and the options sensor.min_range_m and "
                  "sensor.max_range_m");
}

const Odometry& OdometrySession::odometry() const {
  exclusive_.AwaitReadable();
  return odometry_;
}

FlaggedTrajectory OdometrySession::Poses() const {
  const PoseFlags flags(odometry().trajectory().poses(), odometry_.lost_at_ns());
  return FlaggedTrajectory(odometry_.trajectory(), flags);
}

py::dict OdometrySession::Windows() const {
  exclusive_.AwaitReadable();
  return WindowTable(windows_);
}

py::array_t<double> OdometrySession::Covariances() const {
  exclusive_.AwaitReadable();
  if (!request_.covariance) {
    throw StateError("the covariances were not asked for: Odometry(..., covariance=True)");
  }
  py::array_t<double> array(
      {static_cast<py::ssize_t>(covariances_.size()), py::ssize_t{6}, py::ssize_t{6}});
  double* out = array.mutable_data();
  for (const Matrix6d& covariance : covariances_) {
    out = std::copy_n(covariance.data(), 36, out);
  }
  return array;
}

py::array_t<double> OdometrySession::MapPoints() const {
  const VoxelHashMap& points = odometry().map().finest();
  py::array_t<double> array({static_cast<py::ssize_t>(points.size()), py::ssize_t{3}});
  double* out = array.mutable_data();
  points.ForEachPoint(
      [&](const MapPoint& point) { out = std::copy_n(point.place_world.data(), 3, out); });
  return array;
}

py::dict OdometrySession::PointCounts() const {
  const trajlo::PointCounts counts = odometry().point_counts();
  py::dict dict;
  dict["received"] = counts.received;
  dict["kept"] = counts.Kept();
  dict["not_finite"] = counts.not_finite;
  dict["too_near"] = counts.too_near;
  dict["too_far"] = counts.too_far;
  dict["too_late"] = counts.too_late;
  dict["wrong_time"] = counts.wrong_time;
  return dict;
}

std::vector<std::pair<py::array_t<double>, double>> OdometrySession::Rig() const {
  std::vector<std::pair<py::array_t<double>, double>> rig;
  for (const SE3& given : config_.odometry.segmenter.T_body_lidar) {
    const LidarCorrection correction = odometry().rig().Correction(rig.size());
    rig.emplace_back(PoseArray(correction.T_body * given), correction.clock_s);
  }
  return rig;
}

std::vector<std::string> OdometrySession::Remarks() const {
  RunSummary summary;
  summary.times = odometry().time_report();
  std::vector<std::string> remarks = summary.times.remarks;
  const std::string odd_stamps = summary.OddStamps();
  if (!odd_stamps.empty()) {
    remarks.push_back("of " + CountOf(summary.times.scans, "scan") + ": " + odd_stamps);
  }
  if (scans_ > 1 && first_stamp_ns_ < last_stamp_ns_ &&
      (last_stamp_ns_ - first_stamp_ns_) / (scans_ - 1) < kShortest_ns) {
    remarks.push_back("all " + std::to_string(scans_) + " scans have stamps within " +
                      std::to_string(last_stamp_ns_ - first_stamp_ns_) +
                      " ns: stamp_ns counts nanoseconds, not scans, and in no other unit");
  }
  summary.flags = PoseFlags(odometry().trajectory().poses(), odometry().lost_at_ns());
  for (const WindowStatistics& window : windows_) summary.windows.Add(window);
  for (const std::string& warning : FlagWarnings(summary)) remarks.push_back(warning);
  const std::size_t given = config_.odometry.segmenter.T_body_lidar.size();
  if (given > 1 && newest_lidar_ + 1 < static_cast<int>(given)) {
    remarks.push_back("sensor.T_body_lidar has the poses of " + std::to_string(given) +
                      " LiDARs, but no scan came with a larger number than " +
                      std::to_string(newest_lidar_) + " (counted from 0)");
  }
  return remarks;
}

std::string OdometrySession::Shortcomings() const {
  RunSummary summary;
  summary.times = odometry().time_report();
  summary.points = odometry().point_counts();
  const std::vector<ControlPose>& poses = odometry().trajectory().poses();
  summary.TakePoses(poses);
  summary.flags = PoseFlags(poses, odometry().lost_at_ns());
  return summary.Shortcomings();
}

}  // namespace trajlo::python
