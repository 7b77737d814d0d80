// SPDX-License-Identifier: MIT
#include "apps/convert/convert_scans.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "core/io/conversion/open_bag.h"
#include "core/io/conversion/pcd_folder_writer.h"
#include "core/io/conversion/scan_bag_writer.h"
#include "core/io/errors.h"
#include "core/io/recording/open_clouds.h"
#include "core/io/recording/open_recording.h"
#include "core/report/progress_bar.h"

namespace trajlo {
namespace {

constexpr int kAllCores = 0;

/// The topics with points of all inputs, one for each LiDAR; empty texts for folders of scans.
std::vector<std::string> LidarTopics(const std::vector<std::string>& inputs,
                                     const RecordingOptions& options) {
  const std::vector<std::string>& wanted = options.topics;
  CloudOptions how;
  how.packets.velodyne_model = options.velodyne_model;
  std::vector<std::string> lidars;
  for (const std::string& input : inputs) {
    if (!HoldsClouds(input)) {
      lidars.emplace_back();
    } else if (!wanted.empty()) {
      lidars.insert(lidars.end(), wanted.begin(), wanted.end());
    } else {
      const auto clouds = OpenClouds(input, how);
      for (std::size_t i = 0; i < clouds->topics().size(); ++i) {
        const Topic& topic = clouds->topics()[i];
        if (clouds->IsCloud(i) && topic.messages > 0) lidars.push_back(topic.name);
      }
    }
  }
  return lidars;
}

/// A name for each LiDAR, the one that it had where that is possible.
std::vector<std::string> OwnTopics(CloudLayout layout, std::vector<std::string> topics) {
  const std::size_t count = topics.size();
  for (std::size_t i = 0; i < count; ++i) {
    // Folders have no topics, and those of captures are no names for ROS.
    const bool is_name = !topics[i].empty() && topics[i].front() == '/';
    if (!is_name) topics[i] = TopicOf(layout, i, count);
  }
  // LiDARs that share a name would be one for every reader.
  if (std::set<std::string>(topics.begin(), topics.end()).size() == count) return topics;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string own = TopicOf(layout, i, count);
    std::fprintf(stderr, "trajlo_convert: lidar %zu becomes %s: several LiDARs have one name\n", i,
                 own.c_str());
    topics[i] = own;
  }
  return topics;
}

/// Takes the scans of one kind of output.
class Output {
 public:
  virtual ~Output() = default;
  virtual void Write(const LidarScan& scan, std::int64_t recorded_ns) = 0;
  virtual void Close() = 0;
};

class BagOutput : public Output {
 public:
  BagOutput(const ConvertRequest& request, std::vector<std::string> topics)
      : layout_(request.layout.value_or(CloudLayout::kOuster)),
        topics_(OwnTopics(layout_, std::move(topics))),
        bag_(OpenBag(request.output, request.compression, request.WhatIfExists())) {}

  void Write(const LidarScan& scan, std::int64_t recorded_ns) override {
    const std::int64_t start_ns = SweepStartOf(scan);
    const auto lidar = static_cast<std::size_t>(scan.lidar_id);
    bag_.WriteScan(layout_, topics_.at(lidar), "lidar" + std::to_string(lidar),
                   {start_ns, start_ns, recorded_ns}, scan);
  }
  void Close() override { bag_.Close(); }

 private:
  CloudLayout layout_;
  std::vector<std::string> topics_;
  ScanBagWriter bag_;
};

class FolderOutput : public Output {
 public:
  FolderOutput(const ConvertRequest& request, std::size_t lidars) {
    PrepareScanFolder(request.output, request.WhatIfExists());
    for (std::size_t i = 0; i < lidars; ++i) {
      folders_.emplace_back(lidars == 1 ? request.output
                                        : request.output / ("lidar" + std::to_string(i)));
    }
  }
  void Write(const LidarScan& scan, std::int64_t recorded_ns) override {
    PcdFolderWriter& folder = folders_.at(static_cast<std::size_t>(scan.lidar_id));
    if (folders_.size() == 1) return folder.Write(scan);
    folder.Write(scan, recorded_ns);
  }
  void Close() override {
    for (PcdFolderWriter& folder : folders_) folder.Close();
  }

 private:
  std::vector<PcdFolderWriter> folders_;
};

/// When scans are said to be recorded: stamped at the start and recorded at the end of the sweep,
/// every reader that goes by evidence sees which is which. Later than the scan before it in any
/// case, so that broken stamps do not change the order.
class RecordTimes {
 public:
  std::int64_t Next(const LidarScan& scan) {
    last_ns_ = std::max(last_ns_ + 1, SweepEndOf(scan));
    return last_ns_;
  }

 private:
  std::int64_t last_ns_ = std::numeric_limits<std::int64_t>::min();
};

std::unique_ptr<Output> OpenOutput(const ConvertRequest& request,
                                   const std::vector<std::string>& topics) {
  if (request.WritesBag()) return std::make_unique<BagOutput>(request, topics);
  return std::make_unique<FolderOutput>(request, topics.size());
}

}  // namespace

ConvertedScans ConvertScans(const ConvertRequest& request, const std::atomic<bool>& stop) {
  const std::vector<std::string> inputs = InputPaths(request.input);
  RecordingOptions options = request.recording;
  const std::vector<std::string> topics = LidarTopics(inputs, options);
  // All LiDARs of a bag, where trajlo_run would ask which. Several inputs choose their own.
  if (inputs.size() == 1 && HoldsClouds(inputs.front())) options.topics = topics;
  const std::unique_ptr<ScanSource> recording = OpenRecording(inputs, options, kAllCores);
  if (!request.quiet) std::printf("%s\n", recording->description().c_str());
  std::fflush(stdout);
  std::unique_ptr<Output> output;
  ConvertedScans converted;
  converted.lidars = topics.size();
  {
    ProgressBar progress(stderr, request.quiet);
    RecordTimes record_times;
    LidarScan scan;
    while (!stop && recording->Next(&scan)) {
      if (output == nullptr) output = OpenOutput(request, topics);
      output->Write(scan, record_times.Next(scan));
      ++converted.scans;
      converted.points += scan.points.size();
      progress.Update(recording->report().scans_read, recording->size());
    }
  }
  converted.report = recording->report();
  if (output == nullptr) {
    throw InputError(request.input, "there is no scan in the part to convert",
                     "Check --topics, --start_s and --duration_s with trajlo_info.");
  }
  output->Close();
  return converted;
}

}  // namespace trajlo
