// SPDX-License-Identifier: MIT
#include "apps/run/run.h"

#include <utility>

#include "core/comparison/forms/ceres_form_solver.h"
#include "core/graph/graph_files.h"
#include "core/io/atomic_file.h"
#include "core/io/format_text.h"
#include "core/io/point_cloud_writer.h"
#include "core/io/rig_yaml.h"
#include "core/report/flag_warnings.h"
#include "core/report/progress_bar.h"
#include "core/report/view_ply.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

double SecondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

SamplingOptions WithGaps(const RunRequest& request) {
  SamplingOptions sampling = request.sampling;
  sampling.max_gap_s = request.config.odometry.segmenter.max_gap_s;
  return sampling;
}

}  // namespace

Run::Run(const RunRequest& request, const ResultFolder& folder, ScanSource* recording,
         RunSummary* summary)
    : request_(request),
      folder_(folder),
      recording_(recording),
      summary_(summary),
      sampler_(WithGaps(request)),
      trajectory_(folder.trajectory(), IfExists::kReplace),
      windows_(folder.windows(), IfExists::kReplace),
      odometry_(request.config.odometry, MakeSolverFactory(request.config.ceres_form)) {
  odometry_.OnScan([this](const LidarScan& scan) {
    sampler_.NoteScan(scan);
    if (view_) view_->Note(scan);
    if (!first_ns_) first_ns_ = scan.stamp_ns;
    newest_ns_ = scan.stamp_ns;
  });
  odometry_.OnWindow([this](const WindowStatistics& window) {
    windows_.Append(window);
    summary_->windows.Add(window);
    inlier_share_ = window.InlierShare();
  });
  if (!request.inspected.empty()) {
    odometry_.OnSolvedWindow(
        [this](std::int64_t index) { return request_.inspected.count(index) > 0; },
        [this](std::int64_t index, const Window& window) {
          WriteGraphFiles(folder_.graphs(), index, window);
        });
  }
  if (request.view) view_.emplace(request.config.odometry.segmenter);
  if (!request.covariance) return;
  covariance_.emplace(folder.covariance(), IfExists::kReplace);
  odometry_.OnPose([this](const ControlPose& pose, const Matrix6d& covariance) {
    covariance_->Append(pose, covariance);
  });
}

template <typename Work>
void Run::Timed(const Work& work) {
  const Clock::time_point begin = Clock::now();
  work();
  if (first_ns_) processing_.Add(newest_ns_, 1e3 * SecondsSince(begin));
}

void Run::Estimate(const std::atomic<bool>& stop) {
  ProgressBar bar(stderr, request_.quiet);
  const Clock::time_point begin = Clock::now();
  LidarScan scan;
  for (std::size_t count = 0; !stop && recording_->Next(&scan); ++count) {
    Timed([&] { odometry_.AddScan(scan); });
    sampler_.Advance(odometry_.trajectory(), [&](std::int64_t t_ns, const SE3& T) {
      Append(t_ns, T);
      return !stop;
    });
    const std::int64_t data_ns = newest_ns_ - first_ns_.value_or(newest_ns_);
    bar.Update(
        {count + 1, recording_->size(), Seconds(data_ns), SecondsSince(begin), inlier_share_});
  }
  Timed([&] { odometry_.Finish(); });
}

/// Of the poses that were written.
PoseFlags Run::Flags() const {
  PoseFlags flags(odometry_.trajectory().poses(), odometry_.lost_at_ns());
  flags.CountPosesAt(written_ns_);
  return flags;
}

void Run::Write() {
  sampler_.Finish(odometry_.trajectory(), [this](std::int64_t t_ns, const SE3& T) {
    Append(t_ns, T);
    return true;
  });
  trajectory_.Flush();
  trajectory_.Close();
  windows_.Close();
  if (covariance_) covariance_->Close();
  // Only now it is known from when on the run was lost.
  WriteTextFile(folder_.flags(), FlagsCsv(Flags(), written_ns_), IfExists::kReplace);
  std::vector<CloudPoint> points;
  points.reserve(odometry_.map().finest().size());
  odometry_.map().finest().ForEachPoint([&](const MapPoint& point) {
    points.push_back({point.place_world.cast<float>(), 0.0F});
  });
  WritePointCloud(folder_.map(), points, CloudFields::kXyz, IfExists::kReplace);
  summary_->map_points = points.size();
  if (view_) WriteViewPly(folder_.view(), view_->Deskew(odometry_.trajectory(), Rig()));
  WriteRig();
}

/// Where the LiDARs of sensor.T_body_lidar were found to be.
std::vector<LidarPlace> Run::Rig() const {
  const std::vector<SE3>& given = request_.config.odometry.segmenter.T_body_lidar;
  std::vector<LidarPlace> rig;
  for (std::size_t i = 0; i < given.size(); ++i) {
    rig.push_back(CorrectedPlace(i, given[i], request_.config.input.clock_offset_s.Of(i),
                                 odometry_.rig().Correction(i), odometry_.rig().EvidenceFor(i)));
  }
  return rig;
}

/// Of several LiDARs, unless they were taken to be where they were said to be.
void Run::WriteRig() const {
  std::vector<SE3> T_body_lidar;
  std::vector<double> clock_offsets_s;
  for (const LidarPlace& place : Rig()) {
    T_body_lidar.push_back(place.T_body_lidar);
    clock_offsets_s.push_back(place.clock_offset_s);
  }
  if (T_body_lidar.size() < 2 || !request_.config.odometry.segmenter.learn_rig) return;
  WriteTextFile(folder_.rig(),
                RigYaml("Where trajlo_run found the LiDARs to be, for --config=", T_body_lidar,
                        clock_offsets_s),
                IfExists::kReplace);
}

void Run::Summarise() const {
  RunSummary& s = *summary_;
  s.read = recording_->report();
  s.points = odometry_.point_counts();
  s.times = odometry_.time_report();
  s.lost_at_ns = odometry_.lost_at_ns();
  s.poses_written = sampler_.written();
  s.warnings = s.times.remarks;
  const std::string odd_stamps = s.OddStamps();
  if (!odd_stamps.empty()) {
    s.warnings.push_back("of " + CountOf(s.times.scans, "scan") + ": " + odd_stamps);
  }
  s.warnings.insert(s.warnings.end(), s.read.warnings.begin(), s.read.warnings.end());
  if (sampler_.scans_without_pose() > 0) {
    s.warnings.push_back(CountOf(sampler_.scans_without_pose(), "scan has", "scans have") +
                         " no pose: repeated, out of order, or without points");
  }
  const std::vector<ControlPose>& poses = odometry_.trajectory().poses();
  s.TakePoses(poses);
  s.too_short = !poses.empty() && s.windows.windows == 0;
  s.flags = Flags();
  s.rig = Rig();
  for (const std::string& warning : RigWarnings(s.rig)) s.warnings.push_back(warning);
  for (const std::string& warning : FlagWarnings(s)) s.warnings.push_back(warning);
  if (!request_.inspected.empty() && *request_.inspected.rbegin() >= s.windows.windows) {
    s.warnings.push_back("--inspect: there is no window " +
                         std::to_string(*request_.inspected.rbegin()) + "; they are counted from " +
                         "0, and there are " + std::to_string(s.windows.windows));
  }
  s.estimation_s = 1e-3 * processing_.total_ms();
  if (s.end_ns) {
    const ProcessingTime::Quantiles quantiles = processing_.PerSecondOfData(*s.end_ns);
    s.median_ms = quantiles.median_ms;
    s.p95_ms = quantiles.p95_ms;
  }
}

void Run::Append(std::int64_t t_ns, const SE3& T_world_body) {
  trajectory_.Append(t_ns, T_world_body);
  written_ns_.push_back(t_ns);
}

}  // namespace trajlo
