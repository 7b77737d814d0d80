// SPDX-License-Identifier: MIT
#include "core/export/result_bag.h"

#include <algorithm>

#include "core/export/map_file.h"
#include "core/io/messages/message_writer.h"
#include "core/io/messages/navigation_messages.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

constexpr char kWorld[] = "world";
constexpr char kBody[] = "body";

/// Topics whose last message counts for all that follows.
TopicDescription Latched(const char* name, const MessageDescription& message) {
  return {name, message, true};
}

std::vector<float> ValuesOf(const PlacedScan& scan, PointFrame frame) {
  const SE3 T_frame_world = FrameFromWorld(frame, scan.T_world_body);
  std::vector<float> values;
  values.reserve(4 * scan.points_world_m.size());
  for (std::size_t i = 0; i < scan.points_world_m.size(); ++i) {
    const Eigen::Vector3f p = (T_frame_world * scan.points_world_m[i]).cast<float>();
    values.insert(values.end(), {p.x(), p.y(), p.z(), scan.intensities[i]});
  }
  return values;
}

}  // namespace

ResultBag::ResultBag(const RunResult& result, PointFrame frame, std::size_t lidars, BagWriter* bag)
    : result_(result), frame_(frame), bag_(bag) {
  for (std::size_t i = 0; i < lidars; ++i) {
    const std::string prefix = lidars > 1 ? "/lidar" + std::to_string(i) : "";
    scan_topics_.push_back({prefix + "/points_deskewed", PointCloud2Description()});
  }
  WriteStaticFrames(lidars);
  WritePath();
}

void ResultBag::WriteStaticFrames(std::size_t lidars) {
  const std::vector<SE3>& extrinsics = result_.config.odometry.segmenter.T_body_lidar;
  std::vector<StampedTransform> frames;
  // Without the recording, the configuration alone knows of all LiDARs.
  for (std::size_t i = 0; i < std::max(lidars, extrinsics.size()); ++i) {
    frames.push_back({begin_ns(), kBody, "lidar" + std::to_string(i),
                      i < extrinsics.size() ? extrinsics[i] : SE3()});
  }
  bag_->Write(Latched("/tf_static", TfMessageDescription()), begin_ns(),
              WriteTransforms(frames, bag_->encoding()));
}

void ResultBag::WritePath() {
  std::vector<StampedPose> poses;
  for (const ControlPose& pose : result_.trajectory.poses()) {
    poses.push_back({pose.t_ns, pose.T_world_body});
  }
  bag_->Write(Latched("/path", PathDescription()), begin_ns(),
              trajlo::WritePath({0, begin_ns(), kWorld}, poses, bag_->encoding()));
}

void ResultBag::WriteScan(const PlacedScan& scan) {
  WritePosesUntil(scan.t_ns);
  // Between poses a viewer would interpolate by other rules.
  if (result_.trajectory.poses()[next_pose_ - 1].t_ns != scan.t_ns) {
    WriteTransform(scan.t_ns, scan.T_world_body);
  }
  const MessageHeader header{0, scan.t_ns, frame_ == PointFrame::kBody ? kBody : kWorld};
  bag_->Write(scan_topics_.at(static_cast<std::size_t>(scan.lidar_id)), scan.t_ns,
              WriteFloatCloud(header, {"x", "y", "z", "intensity"}, ValuesOf(scan, frame_),
                              bag_->encoding()));
}

std::size_t ResultBag::WriteMap(const std::vector<Surfel>& surfels) {
  constexpr std::size_t kMost = 2'000'000;
  const std::size_t step = (surfels.size() + kMost - 1) / kMost;
  std::vector<Surfel> chosen;
  for (std::size_t i = 0; i < surfels.size(); i += step) chosen.push_back(surfels[i]);
  bag_->Write(
      Latched("/map", PointCloud2Description()), begin_ns(),
      WriteFloatCloud({0, begin_ns(), kWorld}, MapFields(), MapValues(chosen), bag_->encoding()));
  return chosen.size();
}

void ResultBag::Finish() { WritePosesUntil(result_.trajectory.poses().back().t_ns); }

void ResultBag::WritePosesUntil(std::int64_t t_ns) {
  const std::vector<ControlPose>& poses = result_.trajectory.poses();
  for (; next_pose_ < poses.size() && poses[next_pose_].t_ns <= t_ns; ++next_pose_) {
    WriteTransform(poses[next_pose_].t_ns, poses[next_pose_].T_world_body);
    WritePose(next_pose_);
  }
}

/// Covariances are of control poses; a pose between two of them is about as certain.
const Matrix6d& ResultBag::NearestCovariance(std::int64_t t_ns) const {
  const auto after = result_.covariances.lower_bound(t_ns);
  if (after == result_.covariances.begin()) return after->second;
  const auto before = std::prev(after);
  const bool is_before =
      after == result_.covariances.end() || t_ns - before->first < after->first - t_ns;
  return is_before ? before->second : after->second;
}

void ResultBag::WritePose(std::size_t index) {
  const std::vector<ControlPose>& poses = result_.trajectory.poses();
  const ControlPose& pose = poses[index];
  OdometryState state;
  state.T_world_body = pose.T_world_body;
  if (!result_.covariances.empty()) state.covariance = NearestCovariance(pose.t_ns);
  const double max_gap_s = result_.config.odometry.segmenter.max_gap_s;
  if (index > 0) {
    const ControlPose& before = poses[index - 1];
    const double seconds = Seconds(pose.t_ns - before.t_ns);
    // The twist of a segment is the same at both of its ends.
    if (seconds <= max_gap_s) {
      state.velocity = Minus(pose.T_world_body, before.T_world_body) / seconds;
    }
  }
  static const TopicDescription topic{"/odometry", OdometryDescription()};
  bag_->Write(topic, pose.t_ns,
              WriteOdometry({static_cast<std::uint32_t>(index), pose.t_ns, kWorld}, kBody, state,
                            bag_->encoding()));
}

void ResultBag::WriteTransform(std::int64_t t_ns, const SE3& T_world_body) {
  static const TopicDescription topic{"/tf", TfMessageDescription()};
  bag_->Write(topic, t_ns,
              WriteTransforms({{t_ns, kWorld, kBody, T_world_body}}, bag_->encoding()));
}

}  // namespace trajlo
