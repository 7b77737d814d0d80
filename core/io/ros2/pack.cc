// SPDX-License-Identifier: MIT
#include "core/io/ros2/pack.h"

#include <lz4frame.h>
#include <zstd.h>

#include <stdexcept>

namespace trajlo {
namespace {

std::string PackZstd(std::string_view bytes) {
  // The levels above cost several times as much and save a few per cent of points.
  constexpr int kLevel = 1;
  std::string packed(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size =
      ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), kLevel);
  if (ZSTD_isError(size) != 0) {
    throw std::runtime_error(std::string("zstd: ") + ZSTD_getErrorName(size));
  }
  packed.resize(size);
  return packed;
}

std::string PackLz4(std::string_view bytes) {
  LZ4F_preferences_t preferences{};
  preferences.frameInfo.contentChecksumFlag = LZ4F_contentChecksumEnabled;
  std::string packed(LZ4F_compressFrameBound(bytes.size(), &preferences), '\0');
  const std::size_t size =
      LZ4F_compressFrame(packed.data(), packed.size(), bytes.data(), bytes.size(), &preferences);
  if (LZ4F_isError(size) != 0) {
    throw std::runtime_error(std::string("lz4: ") + LZ4F_getErrorName(size));
  }
  packed.resize(size);
  return packed;
}

}  // namespace

std::string Pack(Codec codec, std::string_view bytes) {
  return codec == Codec::kZstd ? PackZstd(bytes) : PackLz4(bytes);
}

}  // namespace trajlo
