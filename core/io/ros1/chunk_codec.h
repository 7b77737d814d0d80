// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/io/ros1/byte_buffer.h"

struct LZ4F_dctx_s;

namespace trajlo {

enum class BagCompression { kNone, kBz2, kLz4 };

namespace ros1 {

/// "none", "bz2", "lz4", as chunk headers say it.
std::string_view CompressionName(BagCompression compression);
std::optional<BagCompression> FindCompression(std::string_view name);

/// Decompresses one chunk after the other and keeps the memory that this takes.
class Decompressor {
 public:
  struct Result {
    /// What stands in front of the damage, in stored bytes.
    std::size_t consumed = 0;
    /// What is wrong; empty if nothing.
    std::string damage;
  };

  /// `compression` is kBz2 or kLz4. `plain` becomes all, or the part in front of the damage.
  /// `declared_size` is what the chunk claims to hold: a hint only. Memory grows with what comes
  /// out, up to 1 GiB.
  Result Decompress(BagCompression compression, std::string_view stored,
                    std::uint64_t declared_size, ByteBuffer* plain);

 private:
  std::unique_ptr<LZ4F_dctx_s, void (*)(LZ4F_dctx_s*)> lz4_{nullptr, nullptr};
};

/// For kLz4 a frame as librosbag wants it: independent blocks, a checksum, no size.
/// Throws std::runtime_error if the library fails (2 GiB and more).
std::string Compress(BagCompression compression, std::string_view bytes);

}  // namespace ros1
}  // namespace trajlo
