// SPDX-License-Identifier: MIT
#include "core/io/inspection/cloud_inspector.h"

#include <algorithm>

#include "core/io/errors.h"
#include "core/io/scan_decoder.h"

namespace trajlo {
namespace {

std::vector<FieldDescription> Fields(const PointTable& table) {
  std::size_t first = table.columns.empty() ? 0 : table.columns.front().offset;
  for (const Column& column : table.columns) first = std::min(first, column.offset);
  std::vector<FieldDescription> fields;
  for (const Column& column : table.columns) {
    fields.push_back({column.name, NameOf(column.type), column.offset - first});
  }
  return fields;
}

}  // namespace

void CloudInspector::Add(const CloudMessage& message) {
  ++found_.messages_read;
  if (found_.fields.empty()) found_.fields = Fields(message.table);
  auto& frames = found_.frame_ids;
  if (std::find(frames.begin(), frames.end(), message.frame_id) == frames.end()) {
    frames.push_back(message.frame_id);
  }
  const auto stamp_ns = found_.stamp_is_recorded ? message.recorded_ns : message.stamp_ns;
  try {
    const std::size_t without_time =
        DecodeScan(path_, message.table, found_.convention, stamp_ns, &scan_);
    // Impossible times have taken positions away: the counts are of what the message holds.
    sweeps_.Add(scan_, without_time);
    if (without_time > 0) DecodeScan(path_, message.table, {}, scan_.stamp_ns, &scan_);
  } catch (const InputError& error) {
    if (found_.messages_unreadable++ == 0) found_.first_unreadable = error.what();
    return;
  }
  const std::string& damage = message.table.damage;
  if (!damage.empty() && found_.messages_damaged++ == 0) found_.first_damage = damage;
  stamps_ns_.push_back(scan_.stamp_ns);
  if (has_recorded_times_) recorded_ns_.push_back(message.recorded_ns);
  points_.Add(message.table, scan_);
}

CloudInspection CloudInspector::Summarise() const {
  CloudInspection found = found_;
  const bool compare = has_recorded_times_ && !found.stamp_is_recorded;
  found.stamps = SummariseStamps(stamps_ns_, compare ? recorded_ns_ : std::vector<std::int64_t>());
  found.points = points_.Summarise();
  found.sweeps = sweeps_.Summarise(found.stamps.period_s);
  return found;
}

}  // namespace trajlo
