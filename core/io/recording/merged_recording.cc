// SPDX-License-Identifier: MIT
#include "core/io/recording/merged_recording.h"

#include <algorithm>
#include <utility>

namespace trajlo {

MergedRecording::MergedRecording(std::vector<std::unique_ptr<ScanSource>> sources) {
  for (auto& source : sources) {
    description_ += (description_.empty() ? "" : "\n") + source->description();
    heads_.push_back({std::move(source), {}, false, 0, 0});
  }
  for (Head& head : heads_) head.filled = head.source->Next(&head.scan);
  by_record_times_ = std::all_of(heads_.begin(), heads_.end(), [](const Head& head) {
    return !head.filled || head.source->recorded_ns();
  });
  for (Head& head : heads_) SetOrder(&head);
  UpdateReport();
}

/// Broken stamps tell the order in which scans came as little as anything else.
void MergedRecording::SetOrder(Head* head) const {
  head->order_ns = by_record_times_ ? head->source->recorded_ns().value_or(0) : head->scan.stamp_ns;
}

bool MergedRecording::Next(LidarScan* scan) {
  Head* earliest = nullptr;
  for (Head& head : heads_) {
    if (!head.filled) continue;
    if (earliest == nullptr || head.order_ns < earliest->order_ns) earliest = &head;
  }
  if (earliest == nullptr) return false;
  std::swap(*scan, earliest->scan);
  earliest->filled = earliest->source->Next(&earliest->scan);
  SetOrder(earliest);
  UpdateReport();
  return true;
}

std::size_t MergedRecording::size() const {
  std::size_t sum = 0;
  for (const Head& head : heads_) sum += head.source->size();
  return sum;
}

void MergedRecording::UpdateReport() {
  std::vector<std::string> warnings = std::move(report_.warnings);
  report_ = {};
  for (Head& head : heads_) {
    const ReadReport& part = head.source->report();
    report_.scans_listed += part.scans_listed;
    report_.scans_read += part.scans_read;
    report_.scans_damaged += part.scans_damaged;
    report_.scans_skipped += part.scans_skipped;
    report_.scans_left_out += part.scans_left_out;
    report_.file_is_cut = report_.file_is_cut || part.file_is_cut;
    report_.points_read += part.points_read;
    report_.points_without_time += part.points_without_time;
    report_.points_undeclared += part.points_undeclared;
    report_.topics_without_messages.insert(report_.topics_without_messages.end(),
                                           part.topics_without_messages.begin(),
                                           part.topics_without_messages.end());
    for (; head.warnings < part.warnings.size(); ++head.warnings) {
      warnings.push_back(part.warnings[head.warnings]);
    }
  }
  report_.warnings = std::move(warnings);
}

}  // namespace trajlo
