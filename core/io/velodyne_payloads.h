// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string_view>

namespace trajlo {

/// True if a file that begins with these bytes (1206 at least) holds data packets of a Velodyne one
/// behind the other, without a capture's headers. Such files end in .bin, as KITTI's scans do, and
/// have no header either; but most of a packet's twelve blocks, every 100 bytes, begin with FF EE,
/// which coordinates do not.
inline bool BeginsAsVelodynePayloads(std::string_view bytes) {
  constexpr std::size_t kPacketBytes = 1206, kBlocks = 12, kBlockBytes = 100;
  if (bytes.size() < kPacketBytes) return false;
  std::size_t flagged = 0;
  for (std::size_t block = 0; block < kBlocks; ++block) {
    flagged += bytes.substr(block * kBlockBytes, 2) == "\xff\xee" ? 1 : 0;
  }
  return 2 * flagged > kBlocks;
}

}  // namespace trajlo
