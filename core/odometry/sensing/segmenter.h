// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "core/odometry/sensing/lidar_scan.h"
#include "core/odometry/sensing/segment_cloud.h"
#include "core/odometry/sensing/voxel_filter.h"
#include "manifolds/se3.h"

namespace trajlo {

struct SegmenterOptions {
  /// Length of the first segment, which fills the map (paper: 0.3 s).
  double first_interval_s = 0.3;
  /// Length of all others, the paper's Delta t.
  double interval_s = 0.03;
  double min_range_m = 0.5;
  double max_range_m = 150.0;
  /// At most one point per cell of this size and segment enters the map.
  double map_voxel_m = 0.1;
  /// At most one of those per cell of this size is registered.
  double registration_voxel_m = 0.4;
  /// At most this many are registered of a segment, taken evenly over its points; 0 takes all.
  int max_registration_points = 2000;
  /// A longer pause becomes one gap segment; shorter ones become empty segments.
  double max_gap_s = 1.0;
  /// A LiDAR that lags behind the others by more is not waited for.
  double max_lag_s = 0.5;
  /// Turns every ray of a scan up by this angle about the axis across it: the calibration error of
  /// KITTI's HDL-64E is 0.205 degrees.
  double vertical_correction_deg = 0.0;
  /// One per LiDAR; LiDARs beyond the list have the identity.
  std::vector<SE3> T_body_lidar;
};

/// Cuts the stream of scans into segments, whatever the length of a scan.
///
/// Segment 0 starts at the first point and lasts `first_interval_s`; the others follow without
/// holes. A segment is handed out when every LiDAR has passed its end. Where no scan has point
/// times (motion-corrected ones) each becomes a segment, from the previous stamp to its own, with
/// alpha = 1 for every point: the discrete mode of the paper. The first of these is an instant,
/// which only fills the map. After a gap, such a segment is as long as the one before it. Every
/// other segment lasts a millisecond at least: scans that are closer share one.
///
/// Times must be sane, as ScanSequencer makes them.
///
/// The stream is cut into slots of `interval_s / divisions`; how many of them make a segment is
/// said when the segment is asked for, so that it can depend on all segments before it, and on
/// nothing else.
class Segmenter {
 public:
  explicit Segmenter(const SegmenterOptions& options, int divisions = 1);

  void AddScan(const LidarScan& scan);
  /// No further scans: the segments still open are completed, the last one as far as it is filled.
  void Finish();
  /// The next segment of `slots` slots, oldest first; empty until all of them are complete. It ends
  /// early only before a gap and at the end of the stream. The first segment, a gap, and a scan
  /// without point times are one slot each.
  std::optional<SegmentCloud> Next(int slots = 1);

  const PointCounts& counts() const { return counts_; }

 private:
  struct Slot {
    std::int64_t begin_ns, end_ns;
    bool is_whole;  ///< A segment by itself.
    bool is_gap;
    std::vector<SegmentPoint> points;  ///< With alpha within the slot.
  };
  void AddContinuous(const LidarScan& scan);
  void AddDiscrete(const LidarScan& scan);
  SE3 PoseOf(std::size_t lidar) const;
  bool Accept(const LidarPoint& point, const SE3& T_body_lidar, Eigen::Vector3f* p_body);
  Slot& SlotAt(std::int64_t t_ns);
  Slot* DiscreteSlotAt(std::int64_t stamp_ns);
  void CompletePassed();
  void OpenNext(std::int64_t end_ns, bool is_whole, bool is_gap = false);
  void CompleteUntil(std::int64_t t_ns);
  std::int64_t FirstOpen_ns() const;
  std::vector<SegmentPoint> TakePoints(std::size_t slots);
  void Thin(std::vector<SegmentPoint> points, SegmentCloud* cloud);

  SegmenterOptions options_;
  std::int64_t slot_ns_, max_gap_ns_, max_lag_ns_;
  PointCounts counts_;
  VoxelFilter map_filter_;
  VoxelFilter registration_filter_;
  bool first_taken_ = false;
  std::deque<Slot> slots_;  ///< Not yet handed out, without holes.
  std::int64_t complete_until_ns_;
  std::vector<std::int64_t> newest_ns_;  ///< Newest time of each LiDAR.
  std::optional<std::int64_t> end_ns_;   ///< End of the newest slot.
  bool has_point_times_ = false;         ///< Of any scan so far.
  std::int64_t discrete_step_ns_;        ///< From scan to scan, without point times.
};

}  // namespace trajlo
