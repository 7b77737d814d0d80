// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace trajlo {

/// The stamp that a file name is, in ns: 1583836591.182590976, 1583836591182590976,
/// 1583836591_182590976, or a date and a time of day with a fraction. Short whole numbers are
/// indices, not stamps.
std::optional<std::int64_t> StampOfName(const std::filesystem::path& file);

}  // namespace trajlo
