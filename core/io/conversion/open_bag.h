// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "core/io/messages/bag_writer.h"
#include "core/io/output_file.h"

namespace trajlo {

/// True for names that end in .bag, .mcap or .db3: what OpenBag() writes.
bool IsBagName(const std::filesystem::path& path);

/// The compressions of such a bag by name, the usual one first: "none, lz4 or bz2" of .bag, "zstd,
/// lz4 or none" of .mcap, "none" of .db3.
std::string BagCompressions(const std::filesystem::path& path);

/// Opens a bag for writing; the name's end tells its kind. An empty `compression` is the usual one.
/// Throws OutputError, and std::invalid_argument for another kind or compression.
std::unique_ptr<BagWriter> OpenBag(const std::filesystem::path& path,
                                   const std::string& compression = "",
                                   IfExists if_exists = IfExists::kFail);

/// True if OpenBag() knows this compression for that kind of bag.
bool IsBagCompression(const std::filesystem::path& path, const std::string& compression);

}  // namespace trajlo
