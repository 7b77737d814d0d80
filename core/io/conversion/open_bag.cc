// SPDX-License-Identifier: MIT
#include "core/io/conversion/open_bag.h"

#include <stdexcept>

#include "core/io/ros1/ros1_bag_writer.h"
#include "core/io/ros2/db3_writer.h"
#include "core/io/ros2/mcap_writer.h"

namespace trajlo {

bool IsBagName(const std::filesystem::path& path) {
  return path.extension() == ".bag" || path.extension() == ".mcap" || path.extension() == ".db3";
}

std::string BagCompressions(const std::filesystem::path& path) {
  if (path.extension() == ".bag") return "none, lz4 or bz2";
  return path.extension() == ".mcap" ? "zstd, lz4 or none" : "none";
}

bool IsBagCompression(const std::filesystem::path& path, const std::string& compression) {
  if (compression.empty() || compression == "none") return true;
  if (path.extension() == ".bag") return ros1::FindCompression(compression).has_value();
  return path.extension() == ".mcap" && (compression == "zstd" || compression == "lz4");
}

std::unique_ptr<BagWriter> OpenBag(const std::filesystem::path& path,
                                   const std::string& compression, IfExists if_exists) {
  if (!IsBagName(path) || !IsBagCompression(path, compression)) {
    throw std::invalid_argument("no bag is written as '" + path.extension().string() + "' with '" +
                                compression + "'");
  }
  if (path.extension() == ".bag") {
    Ros1BagOptions options;
    if (!compression.empty()) options.compression = *ros1::FindCompression(compression);
    options.if_exists = if_exists;
    return std::make_unique<Ros1BagWriter>(path, options);
  }
  if (path.extension() == ".db3") return std::make_unique<Db3Writer>(path, if_exists);
  McapOptions options;
  if (compression == "lz4") options.compression = Codec::kLz4Frame;
  if (compression == "none") options.compression = std::nullopt;
  options.if_exists = if_exists;
  return std::make_unique<McapWriter>(path, options);
}

}  // namespace trajlo
