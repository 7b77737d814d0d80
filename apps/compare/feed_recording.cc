// SPDX-License-Identifier: MIT
#include "apps/compare/feed_recording.h"

#include <cstdio>

#include "core/io/recording/open_recording.h"
#include "core/report/progress_bar.h"
#include "core/report/run_summary.h"
#include "core/scans/nanoseconds.h"
#include "core/timing/stopwatch.h"

namespace trajlo {

Feed FeedRecording(const CompareRequest& request, const std::string& name,
                   const std::atomic<bool>& stop, const double& inlier_share, Odometry* odometry) {
  Feed feed;
  const auto recording = OpenRecording(request.inputs, request.config.input);
  ProgressBar bar(stderr, request.quiet);
  Stopwatch watch;
  std::int64_t first_ns = 0;
  LidarScan scan;
  for (std::size_t count = 0; !stop && recording->Next(&scan); ++count) {
    if (count == 0) first_ns = scan.stamp_ns;
    odometry->AddScan(scan);
    feed.wall_s += watch.Seconds();
    bar.Update({count + 1, recording->size(), Seconds(scan.stamp_ns - first_ns), feed.wall_s,
                inlier_share, name});
  }
  odometry->Finish();
  feed.wall_s += watch.Seconds();

  RunSummary summary;
  summary.read = recording->report();
  summary.points = odometry->point_counts();
  summary.times = odometry->time_report();
  const std::vector<ControlPose>& poses = odometry->trajectory().poses();
  summary.TakePoses(poses);
  summary.flags = PoseFlags(poses, odometry->lost_at_ns());
  feed.shortcomings = summary.Shortcomings();
  feed.warnings = summary.times.remarks;
  feed.warnings.insert(feed.warnings.end(), summary.read.warnings.begin(),
                       summary.read.warnings.end());
  feed.lost_at_ns = odometry->lost_at_ns();
  return feed;
}

}  // namespace trajlo
