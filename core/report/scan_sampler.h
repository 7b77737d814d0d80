// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "core/odometry/segments/segmenter.h"
#include "core/odometry/trajectory/trajectory.h"
#include "core/report/rig_report.h"

namespace trajlo {

struct ScanSamplingOptions {
  /// The points of this much time are seen together: a sweep of most LiDARs.
  std::int64_t moment_ns = 100'000'000;
  /// With the points of a moment, this bounds the memory however long the run is.
  std::size_t max_moments = 300;
  std::size_t points_per_moment = 2500;
};

/// One return at the place where it was measured.
struct WorldPoint {
  Eigen::Vector3f p_world_m;
  float intensity;
  std::int64_t moment_ns;  ///< When the moment began in which it was measured.
};

/// Keeps a thinned choice of what the LiDARs see, to be shown when the run is over: moments at even
/// distances over the whole run, and of each the points of all LiDARs, up to a number. While the
/// run grows the distance between moments doubles and every other one is dropped.
///
/// Points are drawn with probabilities in proportion to their range, since there are so many more
/// of them near the sensor. The choice depends on nothing but the scans.
class ScanSampler {
 public:
  /// Points are used that the estimator uses (by range, without NaN), where it takes them to be.
  explicit ScanSampler(const SegmenterOptions& segmenter, const ScanSamplingOptions& options = {})
      : segmenter_(segmenter), options_(options) {}

  void Note(const LidarScan& scan);

  /// The points kept so far that `trajectory` covers, but for its pauses, deskewed, moment by
  /// moment, with the LiDARs where they were found to be; one that is not among them is the body,
  /// with the right time.
  std::vector<WorldPoint> Deskew(const Trajectory& trajectory,
                                 const std::vector<LidarPlace>& rig) const;

 private:
  struct Kept {
    Eigen::Vector3f p_lidar_m;
    float intensity;
    std::int64_t t_ns;
    float key;  ///< Those with the smallest are kept.
    std::uint16_t lidar;
  };
  struct Moment {
    std::vector<Kept> points;
    /// Once there were too many: larger ones are not wanted.
    float largest_key = std::numeric_limits<float>::infinity();
  };

  void SetKeys(const std::vector<LidarPoint>& points);
  void Take(const LidarScan& scan, std::size_t first, std::size_t end, Moment* moment);
  void DropEveryOther();

  SegmenterOptions segmenter_;
  ScanSamplingOptions options_;
  std::vector<float> variates_;  ///< Exponential ones of rate 1, by the index of a point.
  std::vector<float> keys_;      ///< Of the points of the present scan.
  std::vector<float> smallest_;  ///< Of a moment, in no order.
  std::optional<std::int64_t> origin_ns_;
  std::int64_t stride_ = 1;  ///< Moments from one that is kept to the next.
  std::map<std::int64_t, Moment> moments_;
};

}  // namespace trajlo
