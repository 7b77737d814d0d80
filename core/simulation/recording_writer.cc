// SPDX-License-Identifier: MIT
#include "core/simulation/recording_writer.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "core/io/format_text.h"
#include "core/io/output_file.h"
#include "core/io/point_cloud_writer.h"
#include "core/io/stamp_text.h"
#include "core/scans/nanoseconds.h"
#include "core/simulation/scenario_yaml.h"
#include "core/simulation/scene_picture.h"

namespace trajlo::simulation {

namespace fs = std::filesystem;

namespace {

void MakeFolder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) {
    throw std::runtime_error("cannot create the folder '" + path.string() +
                             "': " + error.message());
  }
}

void WriteFile(const fs::path& path, const std::string& head, const std::vector<float>& body = {}) {
  OutputFile file(path, IfExists::kReplace);
  file.Write(head);
  file.Write({reinterpret_cast<const char*>(body.data()), body.size() * sizeof(float)});
  file.Close();
}

void WritePcd(const fs::path& path, const SimulatedScan& simulated) {
  const std::vector<LidarPoint>& points = simulated.scan.points;
  std::vector<float> data;
  data.reserve(5 * points.size());
  for (const LidarPoint& p : points) {
    data.insert(data.end(), {p.xyz_m.x(), p.xyz_m.y(), p.xyz_m.z(), p.intensity});
    data.push_back(static_cast<float>(Seconds(p.t_ns - simulated.sweep_start_ns)));
  }
  WriteFile(path, PcdHeader("x y z intensity time", "FFFFF", points.size()), data);
}

void WriteKittiBin(const fs::path& path, const LidarScan& scan) {
  std::vector<float> data;
  data.reserve(4 * scan.points.size());
  for (const LidarPoint& p : scan.points) {
    data.insert(data.end(), {p.xyz_m.x(), p.xyz_m.y(), p.xyz_m.z(), p.intensity / 255.0F});
  }
  WriteFile(path, "", data);
}

/// With more decimals of the rotation than TumWriter: it is the truth.
std::string TumLine(std::int64_t t_ns, const SE3& T) {
  return FormatText("%s %.9f %.9f %.9f %.12f %.12f %.12f %.12f\n", FormatSeconds(t_ns).c_str(),
                    T.t.x(), T.t.y(), T.t.z(), T.q.x(), T.q.y(), T.q.z(), T.q.w());
}

std::string KittiLine(const SE3& T) {
  const Eigen::Matrix3d R = T.q.toRotationMatrix();
  std::string line;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      if (!line.empty()) line += ' ';
      line += FormatText("%.12g", column < 3 ? R(row, column) : T.t[row]);
    }
  }
  return line + "\n";
}

/// The LiDARs of a bag, in the order of the extrinsics.
std::string TopicsYaml(const std::vector<std::string>& topics) {
  std::string list;
  for (const std::string& topic : topics) list += (list.empty() ? "" : ", ") + topic;
  return "input:\n  topics: [" + list + "]\n";
}

}  // namespace

RecordingWriter::RecordingWriter(const Simulator& simulator, fs::path directory,
                                 const std::optional<BagFormat>& bag)
    : simulator_(simulator),
      directory_(std::move(directory)),
      written_until_ns_(simulator.start_ns()) {
  const Scenario& scenario = simulator.scenario();
  if (bag && scenario.motion_corrected) {
    throw std::invalid_argument("motion-corrected scans are written as KITTI has them, in no bag");
  }
  if (bag) {
    MakeFolder(directory_);
    bag_.emplace(simulator, directory_ / "recording.bag", *bag);
    return;
  }
  for (std::size_t id = 0; id < scenario.rig.size(); ++id) {
    const fs::path folder =
        scenario.rig.size() == 1 ? directory_ : directory_ / ("lidar" + std::to_string(id));
    MakeFolder(folder / (scenario.motion_corrected ? "velodyne" : "scans"));
    streams_.push_back({folder, {}, {}});
  }
}

void RecordingWriter::Write(const SimulatedScan& simulated) {
  const LidarScan& scan = simulated.scan;
  ++scans_;
  points_ += static_cast<std::int64_t>(scan.points.size());
  written_until_ns_ = std::max(written_until_ns_, simulated.true_start_ns + simulated.period_ns);
  if (bag_) {
    bag_->Write(simulated);
    return;
  }
  Stream& stream = streams_.at(static_cast<std::size_t>(scan.lidar_id));
  const std::size_t number = stream.stamps_ns.size();
  if (scan.has_point_times) {
    WritePcd(stream.directory / "scans" / FormatText("%06zu.pcd", number), simulated);
  } else {
    WriteKittiBin(stream.directory / "velodyne" / FormatText("%06zu.bin", number), scan);
  }
  stream.stamps_ns.push_back(scan.stamp_ns);
  stream.recorded_ns.push_back(simulated.RecordedNs());
}

void RecordingWriter::Finish(bool is_whole) {
  const std::int64_t end_ns =
      is_whole ? simulator_.end_ns() : std::min(written_until_ns_, simulator_.end_ns());
  WriteStamps();
  if (bag_) bag_->Finish(end_ns);
  std::string truth;
  for (std::int64_t t = simulator_.start_ns(); t <= end_ns; t += kTruthStepNs) {
    truth += TumLine(t, simulator_.TrueWorldFromBody(t));
  }
  WriteFile(directory_ / "truth.tum", truth);
  WriteFile(directory_ / "scenario.yaml", ScenarioYaml(simulator_.scenario()));
  WriteFile(directory_ / "rig.yaml",
            RigYaml(simulator_.scenario()) + (bag_ ? TopicsYaml(bag_->topics()) : ""));
  WriteFile(directory_ / "picture.svg", ScenePicture(simulator_));
}

void RecordingWriter::WriteStamps() const {
  for (std::size_t id = 0; id < streams_.size(); ++id) {
    const Stream& stream = streams_[id];
    if (simulator_.scenario().motion_corrected) {
      WriteKittiTables(stream, static_cast<int>(id));
      continue;
    }
    WriteFile(stream.directory / "timestamps.txt", FormatStampsFile(stream.stamps_ns));
    if (streams_.size() == 1) continue;
    WriteFile(stream.directory / "record_times.txt", FormatStampsFile(stream.recorded_ns));
  }
}

void RecordingWriter::WriteKittiTables(const Stream& stream, int lidar_id) const {
  const LidarConfig& lidar = simulator_.scenario().rig[static_cast<std::size_t>(lidar_id)];
  const std::int64_t clock_offset_ns = Nanoseconds(lidar.clock_offset_s);
  std::string times;
  std::string poses;
  SE3 T_first_world;
  for (std::size_t i = 0; i < stream.stamps_ns.size(); ++i) {
    const std::int64_t t_ns = stream.stamps_ns[i];
    const SE3 T_world_lidar =
        simulator_.TrueWorldFromBody(t_ns - clock_offset_ns) * lidar.T_body_lidar;
    if (i == 0) T_first_world = T_world_lidar.Inverse();
    times += FormatSeconds(t_ns - simulator_.start_ns()) + "\n";
    poses += KittiLine(T_first_world * T_world_lidar);
  }
  WriteFile(stream.directory / "times.txt", times);
  WriteFile(stream.directory / "poses.txt", poses);
}

}  // namespace trajlo::simulation
