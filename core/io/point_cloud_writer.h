// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/output_file.h"
#include "manifolds/eigen_abi.h"

namespace trajlo {

/// One point of a cloud to be written, metres.
struct CloudPoint {
  Eigen::Vector3f xyz_m = Eigen::Vector3f::Zero();
  float intensity = 0.0F;
};

enum class CloudFields { kXyz, kXyzIntensity };

/// Writes points as float32 in binary, as PCD or PLY (little endian) by the extension of `path`.
/// The file appears under its name only when it is complete. Throws OutputError; also for
/// another extension.
void WritePointCloud(const std::filesystem::path& path, const std::vector<CloudPoint>& points,
                     CloudFields fields = CloudFields::kXyzIntensity,
                     IfExists if_exists = IfExists::kFail);

/// The header of a PCD file of binary values of four bytes: "x y z t" and the format's letters for
/// their types, "FFFU".
std::string PcdHeader(const std::string& fields, std::string_view types, std::size_t count);

}  // namespace trajlo
