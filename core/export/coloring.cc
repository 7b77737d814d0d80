// SPDX-License-Identifier: MIT
#include "core/export/coloring.h"

#include <algorithm>
#include <cmath>

#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

/// At even distances; between them colours are interpolated.
constexpr Rgb kTurbo[] = {
    {48, 18, 59},   {64, 64, 162},  {70, 107, 227}, {66, 148, 255}, {40, 188, 235}, {24, 221, 194},
    {50, 242, 152}, {109, 254, 98}, {164, 252, 60}, {205, 236, 52}, {238, 207, 58}, {253, 172, 52},
    {251, 126, 33}, {235, 80, 14},  {208, 47, 5},   {169, 22, 1},   {122, 4, 3}};
constexpr std::size_t kColors = sizeof(kTurbo) / sizeof(Rgb);

double ValueOf(const Surfel& surfel, ColorBy by, std::int64_t origin_ns) {
  switch (by) {
    case ColorBy::kHeight:
      return surfel.p_world_m.z();
    case ColorBy::kIntensity:
      return surfel.intensity;
    case ColorBy::kTime:
      return Seconds(surfel.seen_ns - origin_ns);
  }
  return 0.0;
}

/// The value below which this share of all lies.
double Quantile(std::vector<double> values, double share) {
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

}  // namespace

std::optional<ColorBy> ParseColorBy(std::string_view name) {
  if (name == "height") return ColorBy::kHeight;
  if (name == "intensity") return ColorBy::kIntensity;
  if (name == "time") return ColorBy::kTime;
  return {};
}

Rgb Turbo(double share) {
  const double inside = share > 0.0 ? std::min(share, 1.0) : 0.0;  // NaN, too
  const double at = inside * static_cast<double>(kColors - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(at), kColors - 2);
  const double rest = at - static_cast<double>(below);
  Rgb color{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double mixed = (1.0 - rest) * kTurbo[below][i] + rest * kTurbo[below + 1][i];
    color[i] = static_cast<std::uint8_t>(std::lround(mixed));
  }
  return color;
}

std::vector<Rgb> ColorsOf(const std::vector<Surfel>& surfels, ColorBy by) {
  if (surfels.empty()) return {};
  std::vector<double> values;
  values.reserve(surfels.size());
  for (const Surfel& surfel : surfels) {
    const double value = ValueOf(surfel, by, surfels.front().seen_ns);
    values.push_back(std::isfinite(value) ? value : 0.0);
  }
  const double low = Quantile(values, 0.02), high = Quantile(values, 0.98);
  const double range = high > low ? high - low : 1.0;
  std::vector<Rgb> colors;
  colors.reserve(values.size());
  for (const double value : values) colors.push_back(Turbo((value - low) / range));
  return colors;
}

}  // namespace trajlo
