// SPDX-License-Identifier: MIT
#include "core/io/inspection/inspect_recording.h"

#include <algorithm>
#include <utility>

#include "core/io/errors.h"
#include "core/io/inspection/cloud_inspector.h"
#include "core/io/inspection/folder_clouds.h"
#include "core/io/recording/open_clouds.h"
#include "core/io/recording/open_recording.h"
#include "core/io/recording/probe_times.h"
#include "core/io/scan_folder.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

namespace fs = std::filesystem;
using Open = std::function<std::unique_ptr<CloudMessageReader>()>;

/// Reads the messages and shows each to the inspector of its topic.
class Pass {
 public:
  Pass(const InspectionOptions& options, const CloudMessageReader& reader,
       std::vector<std::size_t> topics)
      : options_(options), topics_(std::move(topics)), seen_(topics_.size()) {
    for (const std::size_t topic : topics_) listed_ += reader.topics()[topic].messages;
    if (options_.messages_per_lidar > 0) {
      listed_ = std::min(listed_, options_.messages_per_lidar * topics_.size());
    }
  }

  void Run(CloudMessageReader* reader, std::vector<CloudInspector>* inspectors) {
    reader->Select(topics_);
    CloudMessage message;
    for (std::size_t n = 0; !IsDone() && reader->Next(&message); ++n) {
      const auto i = static_cast<std::size_t>(
          std::find(topics_.begin(), topics_.end(), message.topic) - topics_.begin());
      const bool enough =
          options_.messages_per_lidar > 0 && seen_[i] >= options_.messages_per_lidar;
      if (enough) continue;
      ++seen_[i];
      (*inspectors)[i].Add(message);
      if (options_.on_progress) options_.on_progress(n + 1, listed_);
    }
  }

 private:
  bool IsDone() const {
    if (options_.should_stop && options_.should_stop()) return true;
    if (options_.messages_per_lidar == 0) return false;
    return std::all_of(seen_.begin(), seen_.end(),
                       [&](std::size_t seen) { return seen >= options_.messages_per_lidar; });
  }

  const InspectionOptions& options_;
  std::vector<std::size_t> topics_;
  std::vector<std::size_t> seen_;
  std::size_t listed_ = 0;
};

void TakeReport(const MessageReport& report, RecordingInspection* inspection) {
  inspection->damaged = inspection->damaged || report.damaged;
  inspection->bytes_lost += report.bytes_lost;
  inspection->warnings.insert(inspection->warnings.end(), report.warnings.begin(),
                              report.warnings.end());
}

void Collect(const std::vector<CloudInspector>& inspectors, bool is_quick,
             RecordingInspection* inspection) {
  std::int64_t begin_ns = 0, end_ns = 0;
  bool any = false;
  const auto extend = [&](std::int64_t t_ns) {
    begin_ns = any ? std::min(begin_ns, t_ns) : t_ns;
    end_ns = any ? std::max(end_ns, t_ns) : t_ns;
    any = true;
  };
  for (const CloudInspector& inspector : inspectors) {
    CloudInspection found = inspector.Summarise();
    for (const std::int64_t t_ns : inspector.recorded_ns()) extend(t_ns);
    if (inspector.recorded_ns().empty() && found.stamps.count > 0) {
      extend(found.stamps.first_ns);
      extend(found.stamps.last_ns);
    }
    if (!inspection->clouds.empty()) {
      found.phase = PhaseOf(inspector.sweep_begins_ns(), inspectors.front().sweep_begins_ns(),
                            inspection->clouds.front().stamps.period_s);
    }
    const bool partial = found.messages_unreadable + found.messages_damaged > 0;
    inspection->damaged = inspection->damaged || partial;
    inspection->clouds.push_back(std::move(found));
  }
  inspection->duration_s = Seconds(end_ns - begin_ns);
  inspection->is_quick = is_quick;
}

/// A folder as trajlo_run opens it, but without point times where their convention is undecided.
std::unique_ptr<ScanFolder> OpenFolder(const std::string& name, std::string* time_problem) {
  ScanFolderOptions options;
  options.read_ahead = false;
  try {
    return std::make_unique<ScanFolder>(name, options);
  } catch (const InputError& error) {
    options.time.use_point_times = false;
    auto folder =
        std::make_unique<ScanFolder>(name, options);  // Throws if that was not the matter.
    *time_problem = error.what();
    return folder;
  }
}

CloudInspector InspectFolder(const std::string& name, const InspectionOptions& options,
                             RecordingInspection* inspection) {
  CloudInspection known;
  const std::unique_ptr<ScanFolder> folder = OpenFolder(name, &known.time_problem);
  FolderClouds reader(folder->listing(), folder->stamps().t_ns);
  const Topic& topic = reader.topics().front();
  known.topic = topic.name;
  known.type = topic.type;
  known.messages_listed = topic.messages;
  known.convention = folder->time_convention();
  known.stamp_is_assumed = folder->has_assumed_stamps();
  inspection->topics.push_back(topic);
  const auto& warnings = folder->stamps().warnings;
  inspection->warnings.insert(inspection->warnings.end(), warnings.begin(), warnings.end());
  std::vector<CloudInspector> inspectors;
  inspectors.emplace_back(name, std::move(known), false);
  Pass(options, reader, {0}).Run(&reader, &inspectors);
  TakeReport(reader.report(), inspection);
  return std::move(inspectors.front());
}

/// Of a rig, each folder is a LiDAR.
RecordingInspection InspectFolders(const std::string& path, const std::vector<std::string>& folders,
                                   const InspectionOptions& options) {
  RecordingInspection inspection;
  inspection.path = path;
  std::vector<CloudInspector> inspectors;
  for (const std::string& name : folders) {
    inspectors.push_back(InspectFolder(name, options, &inspection));
  }
  Collect(inspectors, options.messages_per_lidar > 0, &inspection);
  return inspection;
}

}  // namespace

RecordingInspection InspectClouds(const fs::path& path, const Open& open,
                                  const InspectionOptions& options) {
  RecordingInspection inspection;
  inspection.path = path.string();
  const std::unique_ptr<CloudMessageReader> reader = open();
  inspection.topics = reader->topics();
  std::vector<std::size_t> topics;
  std::vector<TimeProbe> probes;
  for (std::size_t i = 0; i < inspection.topics.size(); ++i) {
    if (!reader->IsCloud(i)) continue;
    topics.push_back(i);
    probes.emplace_back(path, TimeOptions());
  }
  std::vector<CloudInspector> inspectors;
  if (!topics.empty()) ProbeTimes(topics, open().get(), &probes);
  for (std::size_t i = 0; i < topics.size(); ++i) {
    const Topic& topic = inspection.topics[topics[i]];
    CloudInspection known;
    known.topic = topic.name;
    known.type = topic.type;
    known.remark = topic.remark;
    known.messages_listed = topic.messages;
    known.stamp_is_recorded = probes[i].readable() > 0 && !probes[i].HasStamps();
    try {
      known.convention = probes[i].Decide();
    } catch (const InputError& error) {
      known.time_problem = error.what();
    }
    inspectors.emplace_back(path, std::move(known), true);
  }
  if (!topics.empty()) Pass(options, *reader, topics).Run(reader.get(), &inspectors);
  TakeReport(reader->report(), &inspection);
  Collect(inspectors, options.messages_per_lidar > 0, &inspection);
  return inspection;
}

RecordingInspection InspectRecording(const std::string& path, const InspectionOptions& options) {
  const std::vector<std::string> parts = InputPaths(path);
  const bool is_folder = !parts.empty() && !HoldsClouds(parts.front());
  RecordingInspection inspection =
      is_folder ? InspectFolders(path, parts, options)
                : InspectClouds(
                      path, [&] { return OpenClouds(path, options.clouds); }, options);
  inspection.velodyne_model = options.clouds.packets.velodyne_model;
  std::error_code error;
  const fs::path rig = fs::path(path) / "rig.yaml";
  if (fs::is_regular_file(rig, error)) inspection.rig_config = rig.string();
  return inspection;
}

}  // namespace trajlo
