// SPDX-License-Identifier: MIT
// The kinds of Ouster packets, by the metadata files among the fixtures of core/io/packets.
#pragma once

#include <filesystem>
#include <string>

namespace trajlo::fuzz {

constexpr const char* kOusterKinds[] = {"legacy",
                                        "rng15_rfl8_nir8",
                                        "rng15_rfl8_nir8_dual",
                                        "rng19_rfl8_sig16_nir16",
                                        "rng19_rfl8_sig16_nir16_dual",
                                        "fusa_rng15_rfl8_nir8_dual"};

inline std::filesystem::path Metadata(const std::string& kind) {
  return std::filesystem::path(TRAJLO_PACKET_FIXTURES) / ("ouster_" + kind + ".json");
}

}  // namespace trajlo::fuzz
