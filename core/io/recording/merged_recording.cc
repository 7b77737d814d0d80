// SPDX-License-Identifier: MIT
#include "core/io/recording/merged_recording.h"

#include <utility>

namespace trajlo {

MergedRecording::MergedRecording(std::vector<std::unique_ptr<ScanSource>> sources) {
  for (auto& source : sources) {
    description_ += (description_.empty() ? "" : "\n") + source->description();
    heads_.push_back({std::move(source), {}, false});
    Fetch(&heads_.back());
  }
  UpdateReport();
}

void MergedRecording::Fetch(Head* head) { head->filled = head->source->Next(&head->scan); }

bool MergedRecording::Next(LidarScan* scan) {
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

std::size_t MergedRecording::size() const {
  std::size_t sum = 0;
  for (const Head& head : heads_) sum += head.source->size();
  return sum;
}

void MergedRecording::UpdateReport() {
  report_ = {};
  for (const Head& head : heads_) {
    const ReadReport& part = head.source->report();
    report_.scans_listed += part.scans_listed;
    report_.scans_read += part.scans_read;
    report_.scans_damaged += part.scans_damaged;
    report_.scans_skipped += part.scans_skipped;
    report_.file_is_cut = report_.file_is_cut || part.file_is_cut;
    report_.points_read += part.points_read;
    report_.points_without_time += part.points_without_time;
    report_.warnings.insert(report_.warnings.end(), part.warnings.begin(), part.warnings.end());
  }
}

}  // namespace trajlo
