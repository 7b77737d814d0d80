// SPDX-License-Identifier: MIT
#include "core/io/inspection/run_advice.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "core/io/messages/fixed_frame.h"

namespace trajlo {
namespace {

/// Datasets that give themselves away by their topics, in the order of their LiDARs.
struct KnownDataset {
  const char* config;
  const char* name;
  std::vector<std::string> topics;
  /// The config says that stamps mark the end of the sweep.
  bool stamps_at_end;
  /// The config says where the LiDARs sit.
  bool has_extrinsics;
};

const std::vector<KnownDataset>& KnownDatasets() {
  static const std::vector<KnownDataset> datasets = {
      {"ntu_viral",
       "NTU VIRAL",
       {"/os1_cloud_node1/points", "/os1_cloud_node2/points"},
       true,
       true},
      {"ntu_viral_horizontal", "NTU VIRAL", {"/os1_cloud_node1/points"}, true, true},
      {"ntu_viral_vertical", "NTU VIRAL", {"/os1_cloud_node2/points"}, true, true},
      {"hilti2021_both",
       "the Hilti challenge 2021",
       {"/os_cloud_node/points", "/livox/lidar"},
       false,
       false},
  };
  return datasets;
}

bool HasField(const CloudInspection& cloud, const std::string& name, const std::string& type) {
  return std::any_of(cloud.fields.begin(), cloud.fields.end(), [&](const FieldDescription& field) {
    return field.name == name && (type.empty() || field.type == type);
  });
}

bool Contains(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

/// KITTI keeps its scans in velodyne/ or velodyne_points/data/. By its calibration the rays of its
/// HDL-64E end at -23.7 degrees, others of that model at -24.8: the wrong angles that the
/// correction in the config is for.
bool IsLikeKitti(const CloudInspection& cloud) {
  if (cloud.type != ".bin files") return false;
  const std::filesystem::path folder(cloud.topic);
  const std::filesystem::path parent = folder.parent_path().filename();
  const bool named = folder.filename() == "velodyne" ||
                     (folder.filename() == "data" && parent == "velodyne_points");
  const PointSummary& points = cloud.points;
  return named && points.elevation_1_deg > -24.2 && points.elevation_1_deg < -22.0 &&
         points.elevation_99_deg > 0.0 && points.elevation_99_deg < 4.5;
}

/// The drivers of the VLP-16 and the HDL-32E give `time` in seconds within the sweep. Others use
/// the same names, and mean other times or have more lasers.
bool IsLikeVelodyne(const CloudInspection& cloud) {
  const TimeConvention& times = cloud.convention;
  const bool has_fields = HasField(cloud, "time", "float32") && HasField(cloud, "ring", "");
  const bool are_of_the_sweep =
      times.field == "time" && times.unit == TimeUnit::kSeconds && !times.IsAbsolute();
  constexpr std::uint32_t kMostLasers = 32;
  return has_fields && are_of_the_sweep &&
         (!cloud.points.rings || cloud.points.rings->highest < kMostLasers);
}

std::string Lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// Hesai's driver gives `timestamp` in seconds, but so do those of others (RoboSense): its topics
/// or frames must say whose it is, as "/hesai/pandar" and "PandarXT-32" do.
bool IsLikeHesai(const CloudInspection& cloud) {
  if (!HasField(cloud, "timestamp", "float64")) return false;
  std::vector<std::string> names = cloud.frame_ids;
  names.push_back(cloud.topic);
  return std::any_of(names.begin(), names.end(), [](const std::string& name) {
    const std::string lower = Lower(name);
    return Contains(lower, "hesai") || Contains(lower, "pandar");
  });
}

/// The config of a LiDAR, by what writes such points; empty if nothing is typical.
std::string ConfigOf(const CloudInspection& cloud) {
  if (IsLikeKitti(cloud)) return "kitti";
  if (HasField(cloud, "offset_time", "") || Contains(cloud.topic, "livox")) return "livox";
  if (IsLikeHesai(cloud)) return "hesai";
  if (Contains(cloud.type, "packets")) return Contains(cloud.type, "OS-") ? "ouster" : "velodyne";
  if (HasField(cloud, "t", "uint32") && HasField(cloud, "reflectivity", "")) return "ouster";
  if (IsLikeVelodyne(cloud)) return "velodyne";
  return "";
}

/// The dataset with exactly these topics; null if none is known.
const KnownDataset* FindDataset(const std::vector<CloudInspection>& clouds) {
  for (const KnownDataset& dataset : KnownDatasets()) {
    const bool same =
        dataset.topics.size() == clouds.size() &&
        std::all_of(dataset.topics.begin(), dataset.topics.end(), [&](const std::string& name) {
          return std::any_of(clouds.begin(), clouds.end(),
                             [&](const CloudInspection& cloud) { return cloud.topic == name; });
        });
    if (same) return &dataset;
  }
  return nullptr;
}

/// A word of a command, so that a shell takes it as it is.
std::string Quoted(const std::string& word) {
  const bool plain = std::all_of(word.begin(), word.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 ||
           std::string("/._-=,:+@%").find(static_cast<char>(c)) != std::string::npos;
  });
  if (plain) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

std::string TopicList(const std::vector<std::string>& topics) {
  std::string list;
  // As YAML: a colon (of a packet stream) would otherwise begin a map.
  for (const std::string& topic : topics) list += (list.empty() ? "\"" : ", \"") + topic + "\"";
  return "[" + list + "]";
}

/// True if the evidence says that stamps mark the start of the sweep.
bool HasStartStamps(const std::vector<CloudInspection>& clouds) {
  return std::any_of(clouds.begin(), clouds.end(), [](const CloudInspection& cloud) {
    const TimeConvention& convention = cloud.convention;
    return convention.origin == TimeOrigin::kSweepStart && convention.HasPointTimes() &&
           convention.stamp_at == StampAt::kStart && !convention.stamp_at_is_assumed;
  });
}

/// What is not known about where the LiDARs sit.
void AddExtrinsicRemarks(const std::vector<CloudInspection>& clouds, bool is_folder,
                         RunAdvice* advice) {
  if (clouds.size() == 1) {
    advice->remarks.emplace_back(
        "poses will be those of the LiDAR unless sensor.T_body_lidar says where it sits on the "
        "body");
    return;
  }
  advice->remarks.emplace_back(
      "where the LiDARs sit is not known, and the command will be refused without it: give "
      "sensor.T_body_lidar, one pose for each in this order, in a config of your own "
      "(--config=...,rig.yaml)");
  const std::string& first = clouds.front().topic;
  advice->remarks.push_back("to run on one LiDAR: " +
                            (is_folder ? "trajlo_run " + first : "--set input.topics=" + first));
}

/// Topics are all that a dataset is known by, and another rig may have the same.
void AddDatasetRemark(const KnownDataset& dataset, bool config_places_lidars, RunAdvice* advice) {
  std::string facts;
  if (dataset.has_extrinsics && config_places_lidars) facts = "its LiDARs sit as on that rig";
  if (dataset.stamps_at_end) {
    facts += std::string(facts.empty() ? "" : ", and ") + "stamps mark the end of the sweep";
  }
  if (facts.empty()) return;
  advice->remarks.push_back(std::string("topics are those of ") + dataset.name +
                            "; the configuration says that " + facts +
                            ", which is right for that dataset only (sensor.T_body_lidar, "
                            "input.stamp_at)");
}

/// What there is to know about scans without times, and about the config that is for such.
void AddTimeRemarks(const CloudInspection& cloud, const std::string& config, RunAdvice* advice) {
  if (!cloud.time_problem.empty()) {
    advice->remarks.push_back("say how the point times of " + cloud.topic +
                              " are meant, or the command will be refused");
  } else if (config == "kitti") {
    advice->remarks.emplace_back(
        "folder and field of view are those of KITTI; the configuration takes the scans for motion-"
        "corrected and turns every ray up by 0.205 degrees, which is right for KITTI's own "
        "recordings only (--set sensor.vertical_correction_deg=0)");
  } else if (!cloud.convention.HasPointTimes()) {
    advice->remarks.emplace_back(
        "the points have no times; if the scans are motion-corrected, add --set "
        "input.point_time=none,window.segments=3");
  }
}

/// Where a sensor is known by its fields and names alone, its model and its carrier are not.
void AddSensorRemarks(const CloudInspection& cloud, const std::string& config, RunAdvice* advice) {
  if (config == "velodyne" && !Contains(cloud.type, "packets")) {
    advice->remarks.emplace_back(
        "the fields are named as by Velodyne's drivers; the configuration keeps to the ranges of a "
        "VLP-16 or HDL-32E, so leave out -c velodyne if it is another LiDAR");
  } else if (config == "hesai") {
    advice->remarks.emplace_back(
        "the configuration keeps to the ranges of a hand-held XT-32 or Pandar, so leave out -c "
        "hesai if the LiDAR sees farther, or is on a car");
  }
}

bool IsInFixedFrame(const CloudInspection& cloud) {
  return std::any_of(cloud.frame_ids.begin(), cloud.frame_ids.end(),
                     [](const std::string& frame_id) { return !DoubtOfFrame(frame_id).empty(); });
}

/// The clouds to run on: a topic without points would be refused, and what is in a fixed frame is
/// mostly another odometry's result, if there are others.
std::vector<CloudInspection> LidarsOf(const RecordingInspection& recording) {
  std::vector<CloudInspection> clouds, in_fixed_frame;
  for (const CloudInspection& cloud : recording.clouds) {
    if (cloud.points.Returns() == 0) continue;
    (IsInFixedFrame(cloud) ? in_fixed_frame : clouds).push_back(cloud);
  }
  return clouds.empty() ? in_fixed_frame : clouds;
}

/// Drivers give each LiDAR a frame of its own.
void AddSameFrameRemarks(const std::vector<CloudInspection>& clouds, RunAdvice* advice) {
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const auto &a = clouds[k].frame_ids, &b = clouds[i].frame_ids;
      if (a.empty() || a.front().empty() || a != b) continue;
      advice->remarks.push_back(clouds[k].topic + " and " + clouds[i].topic +
                                " have the same frame, '" + a.front() +
                                "': they may be two clouds of one LiDAR, of which one is enough");
    }
  }
}

}  // namespace

RunAdvice AdviseRun(const RecordingInspection& recording) {
  RunAdvice advice;
  const std::vector<CloudInspection> clouds = LidarsOf(recording);
  if (clouds.empty()) return advice;
  const KnownDataset* dataset = FindDataset(clouds);
  advice.config = dataset != nullptr ? dataset->config : ConfigOf(clouds.front());
  std::vector<std::string> topics;
  for (const CloudInspection& cloud : clouds) topics.push_back(cloud.topic);
  if (dataset != nullptr) topics = dataset->topics;

  std::string settings;
  // Topics of folders are the folders themselves, which --input names already.
  const bool is_folder = Contains(clouds.front().type, " files");
  const bool choose = topics.size() > 1 || recording.clouds.size() > clouds.size();
  if (choose && !is_folder) settings = "input.topics=" + TopicList(topics);
  const auto set = [&](const std::string& setting) {
    settings += (settings.empty() ? "" : ",") + setting;
  };
  for (const auto& [name, model] : kVelodyneModels) {
    if (recording.velodyne_model == model) set(std::string("input.velodyne_model=") + name);
  }
  if (dataset != nullptr && dataset->stamps_at_end && HasStartStamps(clouds)) {
    set("input.stamp_at=start");
    advice.remarks.emplace_back(
        "stamps of this dataset mark the end of the sweep, but by the evidence these mark its "
        "start: check input.stamp_at");
  }
  const bool is_like_flag = !recording.path.empty() && recording.path.front() == '-';
  advice.command =
      "trajlo_run " + Quoted((is_like_flag ? "./" : "") + recording.path) + " -o result";
  std::string configs = advice.config;
  if (!recording.rig_config.empty()) {
    configs += (configs.empty() ? "" : ",") + recording.rig_config;
  }
  if (!configs.empty()) advice.command += " -c " + Quoted(configs);
  if (!settings.empty()) advice.command += " --set " + Quoted(settings);

  const bool placed =
      !recording.rig_config.empty() || (dataset != nullptr && dataset->has_extrinsics);
  if (!placed) AddExtrinsicRemarks(clouds, is_folder, &advice);
  if (dataset != nullptr) {
    AddDatasetRemark(*dataset, recording.rig_config.empty(), &advice);
  } else {
    AddSameFrameRemarks(clouds, &advice);
  }
  AddSensorRemarks(clouds.front(), advice.config, &advice);
  for (const CloudInspection& cloud : clouds) AddTimeRemarks(cloud, advice.config, &advice);
  return advice;
}

}  // namespace trajlo
