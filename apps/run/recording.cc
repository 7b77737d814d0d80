// SPDX-License-Identifier: MIT
#include "apps/run/recording.h"

#include <filesystem>
#include <sstream>
#include <utility>

namespace trajlo {
namespace {

namespace fs = std::filesystem;

/// Several recordings, merged by the stamps of their scans.
class MergedRecording : public ScanSource {
 public:
  explicit MergedRecording(std::vector<std::unique_ptr<ScanSource>> sources) {
    for (auto& source : sources) {
      description_ += (description_.empty() ? "lidar " : "\nlidar ") +
                      std::to_string(heads_.size()) + ": " + source->description();
      heads_.push_back({std::move(source), {}, false});
      Fetch(&heads_.back());
    }
    UpdateReport();
  }

  bool Next(LidarScan* scan) override {
    Head* earliest = nullptr;
    for (Head& head : heads_) {
      if (!head.filled) continue;
      if (earliest == nullptr || head.scan.stamp_ns < earliest->scan.stamp_ns) earliest = &head;
    }
    if (earliest == nullptr) return false;
    std::swap(*scan, earliest->scan);
    Fetch(earliest);
    UpdateReport();
    return true;
  }

  std::size_t size() const override {
    std::size_t sum = 0;
    for (const Head& head : heads_) sum += head.source->size();
    return sum;
  }
  const std::string& description() const override { return description_; }
  const ReadReport& report() const override { return report_; }

 private:
  struct Head {
    std::unique_ptr<ScanSource> source;
    LidarScan scan;
    bool filled;
  };

  static void Fetch(Head* head) { head->filled = head->source->Next(&head->scan); }

  void UpdateReport() {
    report_ = {};
    for (const Head& head : heads_) {
      const ReadReport& part = head.source->report();
      report_.scans_listed += part.scans_listed;
      report_.scans_read += part.scans_read;
      report_.scans_damaged += part.scans_damaged;
      report_.scans_skipped += part.scans_skipped;
      report_.points_read += part.points_read;
      report_.points_without_time += part.points_without_time;
      report_.warnings.insert(report_.warnings.end(), part.warnings.begin(), part.warnings.end());
    }
  }

  std::vector<Head> heads_;
  std::string description_;
  ReadReport report_;
};

}  // namespace

std::vector<std::string> InputFolders(const std::string& input) {
  std::error_code error;
  std::vector<std::string> folders;
  if (fs::exists(input, error)) {  // A name may hold a comma.
    for (int id = 0;; ++id) {
      const fs::path folder = fs::path(input) / ("lidar" + std::to_string(id));
      if (!fs::is_directory(folder, error)) break;
      folders.push_back(folder.string());
    }
    return folders.empty() ? std::vector<std::string>{input} : folders;
  }
  std::istringstream parts(input);
  for (std::string part; std::getline(parts, part, ',');) {
    if (!part.empty()) folders.push_back(part);
  }
  return folders;
}

std::unique_ptr<ScanSource> OpenRecording(const std::vector<std::string>& folders,
                                          const ScanFolderOptions& options) {
  std::vector<std::unique_ptr<ScanSource>> sources;
  for (const std::string& folder : folders) {
    ScanFolderOptions own = options;
    own.lidar_id = static_cast<int>(sources.size());
    sources.push_back(std::make_unique<ScanFolder>(folder, own));
  }
  if (sources.size() == 1) return std::move(sources.front());
  return std::make_unique<MergedRecording>(std::move(sources));
}

}  // namespace trajlo
