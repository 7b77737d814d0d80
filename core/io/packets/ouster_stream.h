// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/io/packets/ouster_geometry.h"
#include "core/io/packets/ouster_packet.h"
#include "core/io/packets/sweep_points.h"
#include "core/io/packets/sweep_stream.h"

namespace trajlo {

struct OusterStreamOptions {
  std::size_t topic = 0;
  /// Added to the sensor's times.
  std::int64_t clock_offset_ns = 0;
  bool second_returns = true;
  /// False: sweeps are counted, but nothing is decoded and nothing handed out.
  bool decode = true;
};

/// The sweeps of one Ouster sensor: the packets of one frame id.
class OusterStream : public SweepStream {
 public:
  /// `layout` is that of `metadata`.
  OusterStream(const OusterMetadata& metadata, const OusterLayout& layout,
               const OusterStreamOptions& options);

  void Add(const Datagram& packet, std::vector<CloudMessage>* sweeps) override;
  void Finish(std::vector<CloudMessage>* sweeps) override;
  const StreamCounts& counts() const override { return counts_; }

 private:
  enum class Frame { kSame, kNext, kPast };
  Frame Compare(std::uint32_t frame_id) const;
  void Begin(const Datagram& packet);
  void DecodeColumn(const std::uint8_t* column);
  bool IsInWindow(std::size_t measurement_id) const;
  void Close(bool last, std::vector<CloudMessage>* sweeps);

  OusterStreamOptions options_;
  OusterLayout layout_;
  OusterGeometry geometry_;
  std::size_t columns_per_frame_;
  std::size_t first_column_;
  std::size_t window_;
  SweepPoints points_;
  std::optional<std::uint32_t> frame_id_;
  /// Columns of this frame that came.
  std::vector<bool> seen_;
  std::size_t seen_in_window_ = 0;
  StreamCounts counts_;
};

}  // namespace trajlo
