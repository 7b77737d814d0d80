// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "core/odometry/segments/segment_cloud.h"
#include "core/odometry/segments/segment_thinner.h"
#include "core/options/describe.h"
#include "core/scans/lidar_scan.h"
#include "manifolds/se3.h"

namespace trajlo {

struct SegmenterOptions {
  double interval_s = 0.03;
  double min_range_m = 0.5;
  double max_range_m = 150.0;
  double map_voxel_m = 0.2;
  double registration_voxel_m = 0.4;
  int max_registration_points = 2000;
  double max_gap_s = 1.0;
  double max_lag_s = 0.5;
  double vertical_correction_deg = 0.0;
  std::vector<SE3> T_body_lidar;
  bool learn_rig = true;

  template <typename Describer>
  void DescribeSensor(Describer& d) {
    d(OptionFor::kUsers, "T_body_lidar", T_body_lidar,
      "Pose of each LiDAR in the body frame. A single LiDAR needs none: it is the body then.");
    d(OptionFor::kExperts, "learn_rig", learn_rig,
      "Corrects the poses and clocks of several LiDARs by what they see; false takes them for "
      "exact.");
    d(OptionFor::kUsers, "min_range_m", min_range_m, Range<double>{0.0, 1e3},
      "Nearer points are dropped.");
    d(OptionFor::kUsers, "max_range_m", max_range_m, Range<double>{0.1, 1e4},
      "Farther points are dropped.");
    d(OptionFor::kUsers, "vertical_correction_deg", vertical_correction_deg,
      Range<double>{-5.0, 5.0},
      "Turns every ray up by this angle: the calibration error of KITTI's HDL-64E is 0.205.");
  }

  template <typename Describer>
  void Describe(Describer& d) {
    d(OptionFor::kUsers, "interval_s", interval_s, Range<double>{1e-3, 10.0},
      "Length of a segment, the paper's Delta t.");
    d(OptionFor::kExperts, "map_voxel_m", map_voxel_m, Range<double>{1e-3, 10.0},
      "At most one point of a segment enters the map per cell of this size.");
    d(OptionFor::kExperts, "registration_voxel_m", registration_voxel_m, Range<double>{1e-3, 20.0},
      "Of these, at most one is registered per cell of this size; half of it where few cells are "
      "hit.");
    d(OptionFor::kUsers, "max_registration_points", max_registration_points, Range<int>{0, 1000000},
      "At most this many points of a segment are registered, taken evenly; 0 takes all.");
    d(OptionFor::kExperts, "max_gap_s", max_gap_s, Range<double>{1e-3, 1e3},
      "A longer pause becomes one gap segment; shorter ones become empty segments.");
    d(OptionFor::kExperts, "max_lag_s", max_lag_s, Range<double>{0.0, 1e3},
      "A LiDAR that lags farther behind the others is not waited for.");
  }
};

/// Cuts the stream of scans into segments, whatever the length of a scan.
///
/// Segment 0 starts at the first point; the others follow without holes. A segment is handed out
/// when every LiDAR has passed its end, except one that is silent or late. Where no scan has point
/// times (motion-corrected ones) each becomes a segment, from the previous stamp to its own, with
/// alpha = 1 for every point: the discrete mode of the paper. The first of these is an instant,
/// which only fills the map. After a gap, such a segment is as long as the one before it. Every
/// other segment lasts a millisecond at least: scans that are closer share one.
///
/// Times must be sane, as ScanSequencer makes them.
class Segmenter {
 public:
  explicit Segmenter(const SegmenterOptions& options);

  /// Added to the times of the LiDARs' points from the next scan on; not to the stamps of scans
  /// without point times.
  void CorrectClocks(const std::vector<double>& clocks_s) { clocks_s_ = clocks_s; }

  void AddScan(const LidarScan& scan);
  /// No further scans: the segments still open are completed, the last one with what it has.
  void Finish();
  /// The next segment, oldest first; empty until it is complete.
  std::optional<SegmentCloud> Next();

  const PointCounts& counts() const { return counts_; }

 private:
  /// A segment that is being filled.
  struct Slot {
    std::int64_t begin_ns, end_ns;
    bool is_gap;
    std::vector<SegmentPoint> points;
    std::vector<double> clocks_s;  ///< By which the points of each LiDAR were corrected.
    bool is_instant = false;

    bool Holds(std::int64_t t_ns) const { return t_ns >= begin_ns && t_ns < end_ns; }
  };
  double ClockOf_s(std::size_t lidar) const;
  void Look(const LidarScan& scan);
  void AddContinuous(const LidarScan& scan);
  void AddDiscrete(const LidarScan& scan);
  SE3 PoseOf(std::size_t lidar) const;
  bool Accept(const LidarPoint& point, const SE3& T_body_lidar, Eigen::Vector3f* p_body);
  void ReachTo(std::int64_t first_ns);
  Slot& SlotAt(std::int64_t t_ns);
  Slot* DiscreteSlotAt(std::int64_t stamp_ns);
  void CompletePassed();
  void OpenNext(std::int64_t end_ns, bool is_gap = false);
  void CompleteUntil(std::int64_t t_ns);
  std::int64_t FirstOpen_ns() const;

  SegmenterOptions options_;
  std::int64_t interval_ns_, max_gap_ns_, max_lag_ns_;
  PointCounts counts_;
  SegmentThinner thinner_;
  std::size_t usual_points_ = 0;  ///< What a segment holds, and a little more.
  std::deque<Slot> slots_;        ///< Not yet handed out, without holes.
  std::int64_t complete_until_ns_;
  std::vector<double> clocks_s_;
  std::vector<std::int64_t> newest_ns_;  ///< Newest time of each LiDAR.
  std::optional<std::int64_t> end_ns_;   ///< End of the newest slot.
  bool has_point_times_ = false;         ///< Of any scan so far.
  std::int64_t discrete_step_ns_;        ///< From scan to scan, without point times.
  std::int64_t next_look_ns_;            ///< See PointCounts::sight_lines.
};

}  // namespace trajlo
