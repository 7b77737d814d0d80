// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/scans/nanoseconds.h"
#include "core/simulation/simulated_bag.h"
#include "core/simulation/simulated_scan.h"
#include "core/simulation/simulator.h"

namespace trajlo::simulation {

/// Writes a recording as a folder:
///   scans/000000.pcd ...   binary PCD, fields x y z intensity time (float32; time in seconds since
///                          the start of the sweep)
///   timestamps.txt         the stamp of each scan, seconds with 9 decimals
///   truth.tum              poses T_world_body at 1 kHz and true times, `t x y z qx qy qz qw`
///   scenario.yaml          all parameters, with the true extrinsics
///   rig.yaml               the true extrinsics, for trajlo_run --config=
///   picture.svg            the scene and the path from above
/// A rig of several LiDARs has lidar0/, lidar1/ ... with scans/ and timestamps.txt in each, and
/// record_times.txt with the times at which the scans were recorded, as a bag has them. A
/// motion-corrected recording has KITTI's velodyne/000000.bin (x y z intensity, float32), times.txt
/// (seconds since the start of the recording) and poses.txt (3x4 poses of the LiDAR at those times,
/// relative to the first) in place of scans/ and timestamps.txt.
///
/// With a BagFormat, recording.bag takes the place of scans/ and timestamps.txt (see SimulatedBag),
/// and rig.yaml names its topics.
///
/// All forms hold the same points at the same times, to the bit: positions are float32, and times
/// are such that float32 seconds hold them (StorableOffsetNs). Only intensities differ: Livox's
/// messages have whole numbers.
class RecordingWriter {
 public:
  /// Makes the folders. Throws std::runtime_error naming the path that cannot be written, and
  /// std::invalid_argument for motion-corrected scans in a bag.
  RecordingWriter(const Simulator& simulator, std::filesystem::path directory,
                  const std::optional<BagFormat>& bag = {});

  void Write(const SimulatedScan& simulated);
  /// Writes what goes beside the scans; the truth until the end of the last one if they are not all
  /// (`is_whole`) of the recording.
  void Finish(bool is_whole = true);

  std::int64_t scans() const { return scans_; }
  std::int64_t points() const { return points_; }
  /// From the start to the end of the last sweep.
  double seconds() const { return Seconds(written_until_ns_ - simulator_.start_ns()); }

 private:
  struct Stream {
    std::filesystem::path directory;
    std::vector<std::int64_t> stamps_ns;
    std::vector<std::int64_t> recorded_ns;
  };
  void WriteStamps() const;
  void WriteKittiTables(const Stream& stream, int lidar_id) const;

  const Simulator& simulator_;
  std::filesystem::path directory_;
  /// Empty if a bag is written.
  std::vector<Stream> streams_;
  std::optional<SimulatedBag> bag_;
  std::int64_t scans_ = 0;
  std::int64_t points_ = 0;
  std::int64_t written_until_ns_;  ///< The true end of the last sweep.
};

}  // namespace trajlo::simulation
