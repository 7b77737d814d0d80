// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "core/export/surface_map.h"

namespace trajlo {

enum class ColorBy { kHeight, kIntensity, kTime };

/// "height", "intensity" or "time"; nothing for other text.
std::optional<ColorBy> ParseColorBy(std::string_view name);

using Rgb = std::array<std::uint8_t, 3>;

/// Google's Turbo: dark blue at 0, green in the middle, dark red at 1.
Rgb Turbo(double share);

/// A colour for each surfel; the scale spans all values but the lowest and the highest two per
/// cent.
std::vector<Rgb> ColorsOf(const std::vector<Surfel>& surfels, ColorBy by);

}  // namespace trajlo
