// SPDX-License-Identifier: MIT
#include "core/odometry/odometry.h"

#include <algorithm>
#include <cmath>

#include "core/odometry/sensing/scan_sequencer.h"
#include "core/odometry/stopwatch.h"
#include "core/odometry/window/initial_motion.h"
#include "core/odometry/window/sliding_window.h"
#include "manifolds/se3_interpolation.h"

namespace trajlo {
namespace {

double Seconds(std::int64_t ns) { return static_cast<double>(ns) * 1e-9; }

}  // namespace

class Odometry::Impl {
 public:
  Impl(const OdometryOptions& options, const WindowSolverFactory& make_solver)
      : options_(options),
        threads_(options.threads),
        sequencer_(options.segmenter.max_lag_s, [this](const LidarScan& scan) { Segment(scan); }),
        segmenter_(options.segmenter,
                   options.adaptive_interval.enabled ? options.adaptive_interval.divisions : 1),
        interval_(options.adaptive_interval, options.segmenter.interval_s),
        map_(options.map),
        loss_watch_(options.lost, options.threshold.max_m),
        window_(options, &map_, &threads_, make_solver) {}

  void AddScan(const LidarScan& scan) { sequencer_.Add(scan); }

  void Finish() {
    sequencer_.Finish();
    segmenter_.Finish();
    ProcessSegments();
    if (!started_) return;
    while (window_.segments() > 0) Leave();
    SettleFront();
  }

  OdometryOptions options_;
  ThreadPool threads_;
  ScanSequencer sequencer_;
  Segmenter segmenter_;
  SegmentInterval interval_;
  MapPyramid map_;
  LossWatch loss_watch_;
  SlidingWindow window_;
  Trajectory trajectory_;
  std::function<void(const LidarScan&)> on_scan_;
  std::function<void(const WindowStatistics&)> callback_;
  std::function<void(const ControlPose&, const Matrix6d&)> on_pose_;
  std::optional<std::int64_t> lost_at_ns_;

 private:
  /// A scan whose times go on from those before.
  void Segment(const LidarScan& scan) {
    if (on_scan_) on_scan_(scan);
    Stopwatch watch;
    segmenter_.AddScan(scan);
    milliseconds_segment_ += watch.Milliseconds();
    ProcessSegments();
  }

  void ProcessSegments() {
    while (auto cloud = NextSegment()) {
      if (!started_) {
        Start(*cloud);
      } else {
        Process(std::move(*cloud));
      }
    }
  }

  std::optional<SegmentCloud> NextSegment() {
    Stopwatch watch;
    auto cloud = segmenter_.Next(options_.adaptive_interval.enabled ? interval_.slots() : 1);
    milliseconds_segment_ += watch.Milliseconds();
    return cloud;
  }

  /// The first interval: its motion, then its points into the map.
  void Start(const SegmentCloud& cloud) {
    started_ = true;
    Vector6d tau = Vector6d::Zero();
    const double duration_s = Seconds(cloud.end_ns - cloud.begin_ns);
    if (options_.initialization.estimate_motion && duration_s > 0.0) {
      const InitialMotion motion = EstimateInitialMotion(cloud, options_.map, options_.association,
                                                         options_.weights, &threads_);
      const bool is_clear = motion.tau.head<3>().norm() > options_.initialization.clear_motion_m;
      const double gain = is_clear ? 1.0 : options_.initialization.min_gain;
      if (motion.agreement > gain * motion.agreement_at_rest) tau = motion.tau;
    }
    AddToMap(cloud, SE3(), se3::Exp(tau));
    if (duration_s > 0.0) Settle({cloud.begin_ns, SE3(), 0}, Matrix6d::Zero());
    window_.Start(cloud.end_ns, se3::Exp(tau),
                  duration_s > 0.0 ? Vector6d(tau / duration_s) : Vector6d::Zero());
  }

  void Process(SegmentCloud cloud) {
    if (cloud.is_gap) {
      BridgeGap(cloud);
      return;
    }
    const double duration_s = Seconds(cloud.end_ns - cloud.begin_ns);
    WindowStatistics statistics = window_.AddSegment(std::move(cloud));
    if (options_.adaptive_interval.enabled) interval_.Update(RecentTrajectory(), duration_s);
    statistics.index = windows_++;
    statistics.milliseconds_segment = std::exchange(milliseconds_segment_, 0.0);
    if (window_.segments() >= options_.window.segments) {
      const auto [marginalize_ms, map_ms] = Leave();
      statistics.milliseconds_marginalize = marginalize_ms;
      statistics.milliseconds_map = map_ms;
    }
    if (const auto lost_since_ns = loss_watch_.Update(statistics)) {
      statistics.flags |= kFlagLost;
      if (!lost_at_ns_) lost_at_ns_ = lost_since_ns;
    }
    if (callback_) callback_(statistics);
  }

  /// The control poses of the window, and as many settled ones as the interval looks back on.
  Trajectory RecentTrajectory() const {
    const std::vector<ControlPose> window = window_.poses();
    const std::vector<ControlPose>& settled = trajectory_.poses();
    const double history_s = interval_.history_s();
    std::size_t first = settled.size();
    while (first > 0 && (first == settled.size() ||
                         Seconds(window.back().t_ns - settled[first].t_ns) < history_s)) {
      --first;
    }
    Trajectory recent;
    for (std::size_t i = first; i < settled.size(); ++i) recent.Append(settled[i]);
    for (const ControlPose& pose : window) recent.Append(pose);
    return recent;
  }

  /// The pose at the front of the window is final.
  void SettleFront() {
    Settle(window_.front_pose(), on_pose_ ? window_.front_covariance() : Matrix6d::Zero());
  }

  void Settle(const ControlPose& pose, const Matrix6d& covariance) {
    trajectory_.Append(pose);
    if (on_pose_) on_pose_(pose, options_.covariance_scale * covariance);
  }

  /// The oldest segment leaves: its first pose is settled, its points enter the map.
  std::pair<double, double> Leave() {
    Stopwatch watch;
    SettleFront();
    const SlidingWindow::Left left = window_.Marginalize();
    const double marginalize_ms = watch.Milliseconds();
    AddToMap(left.cloud, left.T_begin, left.T_end);
    map_.RemoveFar(left.T_end.t);
    return {marginalize_ms, watch.Milliseconds()};
  }

  /// A pause longer than max_gap_s: nobody knows what happened. The pose is held, at rest.
  void BridgeGap(const SegmentCloud& gap) {
    while (window_.segments() > 0) Leave();
    ControlPose held = window_.front_pose();
    held.flags |= kFlagGap;
    interval_.Reset();
    Settle(held, on_pose_ ? window_.front_covariance() : Matrix6d::Zero());
    window_.Start(gap.end_ns, held.T_world_body, Vector6d::Zero());
  }

  void AddToMap(const SegmentCloud& cloud, const SE3& T_begin, const SE3& T_end) {
    const PointInterpolator to_world(T_begin, T_end);
    points_world_.resize(cloud.map_points.size());
    constexpr std::size_t kChunk = 512;
    threads_.ParallelFor((points_world_.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
      const std::size_t last = std::min(points_world_.size(), (chunk + 1) * kChunk);
      for (std::size_t i = chunk * kChunk; i < last; ++i) {
        const SegmentPoint& point = cloud.map_points[i];
        points_world_[i] = to_world(point.alpha, point.p_body_m.cast<double>());
      }
    });
    map_.Insert(points_world_);
  }

  bool started_ = false;
  std::int64_t windows_ = 0;
  double milliseconds_segment_ = 0.0;
  std::vector<Eigen::Vector3d> points_world_;
};

Odometry::Odometry(const OdometryOptions& options, const WindowSolverFactory& make_solver)
    : impl_(std::make_unique<Impl>(options, make_solver)) {}
Odometry::~Odometry() = default;

void Odometry::AddScan(const LidarScan& scan) { impl_->AddScan(scan); }
void Odometry::Finish() { impl_->Finish(); }
void Odometry::OnScan(std::function<void(const LidarScan&)> callback) {
  impl_->on_scan_ = std::move(callback);
}
void Odometry::OnWindow(std::function<void(const WindowStatistics&)> callback) {
  impl_->callback_ = std::move(callback);
}
void Odometry::OnPose(std::function<void(const ControlPose&, const Matrix6d&)> callback) {
  impl_->on_pose_ = std::move(callback);
}
const Trajectory& Odometry::trajectory() const { return impl_->trajectory_; }
const MapPyramid& Odometry::map() const { return impl_->map_; }
PointCounts Odometry::point_counts() const {
  PointCounts counts = impl_->segmenter_.counts();
  counts.wrong_time = impl_->sequencer_.report().points;
  counts.received += counts.wrong_time;
  return counts;
}
const TimeReport& Odometry::time_report() const { return impl_->sequencer_.report(); }
std::optional<std::int64_t> Odometry::lost_at_ns() const { return impl_->lost_at_ns_; }

}  // namespace trajlo
