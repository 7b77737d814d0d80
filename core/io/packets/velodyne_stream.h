// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/io/packets/sweep_points.h"
#include "core/io/packets/sweep_stream.h"
#include "core/io/packets/velodyne_clock.h"
#include "core/io/packets/velodyne_cutter.h"
#include "core/io/packets/velodyne_model.h"
#include "core/io/packets/velodyne_packet.h"

namespace trajlo {

struct VelodyneStreamOptions {
  std::size_t topic = 0;
  VelodyneModel model = VelodyneModel::kVlp16;
  double cut_deg = 0.0;
  bool second_returns = true;
  /// False: sweeps are counted, but nothing is decoded and nothing handed out.
  bool decode = true;
};

/// The sweeps of one Velodyne sensor. With the azimuth α (of the moment at which the laser fired:
/// the sensor turns on between the azimuths that it reports), elevation ω and distance R of the
/// manuals: x = R cos ω cos α, y = -R cos ω sin α, z = R sin ω + the laser's height. (The manuals'
/// own frame has y forward and x to the right.)
class VelodyneStream : public SweepStream {
 public:
  VelodyneStream(const VelodyneStreamOptions& options, const HourClock& clock);

  void Add(const Datagram& packet, std::vector<CloudMessage>* sweeps) override;
  void Finish(std::vector<CloudMessage>* sweeps) override;
  const StreamCounts& counts() const override { return counts_; }

 private:
  /// Which way a laser looks, turned away from its block's azimuth.
  struct Turn {
    float cos = 1.0F;
    float sin = 0.0F;
  };

  bool IsInOrder(std::int64_t packet_ns, const VelodynePacket& head);
  void TurnLasers(const VelodynePacket& head);
  /// The lasers [first_slot, first_slot + lasers) of a block; with dual return, of two blocks.
  void DecodeFiring(const std::uint8_t* data, const VelodynePacket& head, std::size_t block,
                    std::size_t first_slot, std::int64_t block_ns);
  void Close(std::vector<CloudMessage>* sweeps);

  VelodyneStreamOptions options_;
  const VelodyneGeometry& geometry_;
  HourClock clock_;
  VelodyneCutter cutter_;
  SweepPoints points_;
  std::optional<std::int64_t> last_packet_ns_;
  Turn turns_[VelodyneGeometry::kSlots];
  StreamCounts counts_;
};

}  // namespace trajlo
