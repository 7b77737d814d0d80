// SPDX-License-Identifier: MIT
#include "core/io/packets/ouster_stream.h"

#include <algorithm>
#include <utility>

#include "core/io/packets/byte_order.h"

namespace trajlo {
namespace {

/// A frame id that steps back farther than packets are reordered is that of a restarted sensor.
constexpr std::int32_t kReordering = 8;
/// The slowest turn takes 0.2 s.
constexpr std::int64_t kLongestSweepNs = 1'000'000'000;
/// The year 2116: later times are broken numbers, whose sums would overflow.
constexpr std::uint64_t kLatestNs = std::uint64_t{1} << 62U;

}  // namespace

OusterStream::OusterStream(const OusterMetadata& metadata, const OusterLayout& layout,
                           const OusterStreamOptions& options)
    : options_(options),
      layout_(layout),
      geometry_(metadata),
      columns_per_frame_(metadata.columns_per_frame),
      first_column_(metadata.first_column),
      window_(metadata.window()),
      seen_(metadata.columns_per_frame) {}

OusterStream::Frame OusterStream::Compare(std::uint32_t frame_id) const {
  if (!frame_id_) return Frame::kNext;
  const std::uint32_t difference = frame_id - *frame_id_;
  const auto step = layout_.fusa ? static_cast<std::int32_t>(difference)
                                 : std::int32_t{static_cast<std::int16_t>(difference)};
  if (step == 0) return Frame::kSame;
  return step < 0 && step >= -kReordering ? Frame::kPast : Frame::kNext;
}

void OusterStream::Add(const Datagram& packet, std::vector<CloudMessage>* sweeps) {
  ++counts_.packets;
  if (!layout_.IsLidarPacket(packet.data, packet.size)) {
    ++counts_.broken;
    return;
  }
  const std::uint32_t frame_id = layout_.FrameId(packet.data);
  const Frame frame = Compare(frame_id);
  if (frame == Frame::kPast) {
    ++counts_.late;
    return;
  }
  if (frame == Frame::kNext) {
    Close(false, sweeps);
    frame_id_ = frame_id;
    Begin(packet);
  }
  points_.SetCaptured(packet.captured_ns.value_or(points_.reference_ns()));
  if (!options_.decode) return;
  for (std::size_t i = 0; i < layout_.columns; ++i) DecodeColumn(layout_.Column(packet.data, i));
}

void OusterStream::Begin(const Datagram& packet) {
  ++counts_.sweeps;
  std::uint64_t reference_ns = layout_.TimeNs(packet.data + layout_.packet_header);
  for (std::size_t i = 0; i < layout_.columns; ++i) {
    const std::uint8_t* column = layout_.Column(packet.data, i);
    if (!layout_.IsValid(column)) continue;
    reference_ns = layout_.TimeNs(column);
    break;
  }
  points_.Begin(static_cast<std::int64_t>(std::min(reference_ns, kLatestNs)) +
                options_.clock_offset_ns);
}

void OusterStream::DecodeColumn(const std::uint8_t* column) {
  const std::size_t measurement_id = layout_.MeasurementId(column);
  const bool valid = layout_.IsValid(column);
  if (measurement_id >= columns_per_frame_) {
    // Sensors fill the end of a frame up with columns that are not valid.
    if (valid) ++counts_.broken_columns;
    return;
  }
  if (seen_[measurement_id]) {
    ++counts_.duplicates;
    return;
  }
  seen_[measurement_id] = true;
  if (IsInWindow(measurement_id)) ++seen_in_window_;
  if (!valid) return;
  const std::int64_t t_ns = static_cast<std::int64_t>(std::min(layout_.TimeNs(column), kLatestNs)) +
                            options_.clock_offset_ns - points_.reference_ns();
  if (t_ns > kLongestSweepNs || t_ns < -kLongestSweepNs) {
    ++counts_.broken_columns;
    return;
  }
  const OusterGeometry::Column direction = geometry_.At(measurement_id);
  const std::size_t returns = options_.second_returns ? layout_.return_count : 1;
  SweepPoint* const tail = points_.Tail(2 * layout_.rows);
  std::size_t count = 0;
  const std::uint8_t* pixel = column + layout_.column_header;
  for (std::size_t row = 0; row < layout_.rows; ++row, pixel += layout_.pixel_size) {
    for (std::size_t i = 0; i < returns; ++i) {
      const OusterReturn& at = layout_.returns[i];
      const std::uint32_t range_mm =
          (Little32(pixel + at.range_at) & at.range_mask) * at.range_unit_mm;
      if (range_mm == 0) continue;
      SweepPoint& point = tail[count++];
      geometry_.Place(direction, row, range_mm, &point);
      point.intensity =
          static_cast<float>(Little16(pixel + at.reflectivity_at) & at.reflectivity_mask);
      point.t = static_cast<std::uint32_t>(t_ns);
      point.ring = static_cast<std::uint16_t>(row);
    }
  }
  points_.Grow(count);
}

bool OusterStream::IsInWindow(std::size_t measurement_id) const {
  return (measurement_id + columns_per_frame_ - first_column_) % columns_per_frame_ < window_;
}

void OusterStream::Finish(std::vector<CloudMessage>* sweeps) { Close(true, sweeps); }

void OusterStream::Close(bool last, std::vector<CloudMessage>* sweeps) {
  if (!points_.IsOpen()) return;
  CloudMessage sweep = points_.Finish(options_.topic, "os_sensor");
  if (!options_.decode) return;
  // A recording begins and ends inside a sweep; those are no losses.
  const bool first = counts_.sweeps == 1;
  if (!first && !last) counts_.missing += window_ - seen_in_window_;
  seen_.assign(columns_per_frame_, false);
  seen_in_window_ = 0;
  sweeps->push_back(std::move(sweep));
}

}  // namespace trajlo
