// SPDX-License-Identifier: MIT
#include "core/io/inspection/run_advice.h"

#include <algorithm>
#include <cctype>

namespace trajlo {
namespace {

/// Datasets that give themselves away by their topics, in the order of their LiDARs.
struct KnownDataset {
  const char* config;
  std::vector<std::string> topics;
};

const std::vector<KnownDataset>& KnownDatasets() {
  static const std::vector<KnownDataset> datasets = {
      {"ntu_viral", {"/os1_cloud_node1/points", "/os1_cloud_node2/points"}},
      {"ntu_viral_horizontal", {"/os1_cloud_node1/points"}},
      {"ntu_viral_vertical", {"/os1_cloud_node2/points"}},
      {"hilti2021_both", {"/os_cloud_node/points", "/livox/lidar"}},
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

/// The config of a LiDAR, by what writes such points; empty if nothing is typical.
std::string ConfigOf(const CloudInspection& cloud) {
  if (cloud.type == ".bin files") return "kitti";
  if (HasField(cloud, "offset_time", "") || Contains(cloud.topic, "livox")) return "livox";
  if (HasField(cloud, "timestamp", "float64")) return "hesai";
  if (Contains(cloud.type, "packets")) return Contains(cloud.type, "OS-") ? "ouster" : "velodyne";
  if (HasField(cloud, "t", "uint32") && HasField(cloud, "reflectivity", "")) return "ouster";
  if (HasField(cloud, "time", "float32") && HasField(cloud, "ring", "")) return "velodyne";
  return "";
}

/// The topics of a dataset that is known, in its order; empty if it is none.
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

}  // namespace

RunAdvice AdviseRun(const RecordingInspection& recording) {
  RunAdvice advice;
  // A topic without points would be refused.
  std::vector<CloudInspection> clouds;
  for (const CloudInspection& cloud : recording.clouds) {
    if (cloud.points.total > 0) clouds.push_back(cloud);
  }
  if (clouds.empty()) return advice;
  const KnownDataset* dataset = FindDataset(clouds);
  advice.config = dataset != nullptr ? dataset->config : ConfigOf(clouds.front());
  std::vector<std::string> topics;
  for (const CloudInspection& cloud : clouds) topics.push_back(cloud.topic);
  if (dataset != nullptr) topics = dataset->topics;
  // Topics of folders are the folders themselves, which --input names already.
  const bool is_folder = Contains(clouds.front().type, " files");
  if (is_folder) topics.clear();

  advice.command = "trajlo_run " + Quoted("--input=" + recording.path) + " --output=result";
  if (!advice.config.empty()) {
    advice.config = "config/datasets/" + advice.config + ".yaml";
    advice.command += " --config=" + advice.config;
  }
  const bool choose = topics.size() > 1 || recording.clouds.size() > clouds.size();
  if (choose && !is_folder) {
    advice.command += " " + Quoted("--set=input.topics=" + TopicList(topics));
  }
  if (clouds.size() > 1 && dataset == nullptr) {
    advice.remarks.push_back(
        "where the LiDARs sit is not known: give sensor.T_body_lidar, one pose for each in the "
        "order of the topics, in a config of your own (--config=...,rig.yaml)");
    advice.remarks.push_back(
        "to run on one LiDAR only: --set=input.topics=" +
        (is_folder ? std::string("... or its folder as --input") : clouds.front().topic));
  } else if (dataset == nullptr) {
    advice.remarks.push_back(
        "poses will be those of the LiDAR unless sensor.T_body_lidar says "
        "where it sits on the body");
  }
  for (const CloudInspection& cloud : clouds) {
    if (cloud.time_problem.empty()) continue;
    advice.remarks.push_back("say how the point times of " + cloud.topic +
                             " are meant, or the command will be refused");
  }
  return advice;
}

}  // namespace trajlo
