// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/io/packets/velodyne_model.h"

namespace trajlo {

struct PacketOptions {
  /// Metadata of the Ouster sensors in the capture; empty: looked for beside it.
  std::vector<std::filesystem::path> ouster_metadata;
  /// For packets that do not name their model (old firmware).
  std::optional<VelodyneModel> velodyne_model;
  /// Where a sweep of a Velodyne begins: the azimuth, clockwise from straight ahead.
  double velodyne_cut_deg = 0.0;
  /// False: of dual returns only the strongest (Ouster: the first).
  bool second_returns = true;
  /// An Ouster whose clock counts from power-on (it is more than an hour away from the capture's)
  /// gets a constant offset to the capture's clock. False: its times stay as they are.
  bool join_clocks = true;
  /// Files of bare Velodyne payloads know the time past the hour only: any time within half an
  /// hour of the first packet, ns since 1970.
  std::optional<std::int64_t> start_ns;
};

}  // namespace trajlo
