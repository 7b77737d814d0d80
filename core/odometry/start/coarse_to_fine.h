// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "core/odometry/map/map_pyramid.h"
#include "core/odometry/weights/registration_options.h"
#include "core/odometry/window/step_size.h"

namespace trajlo {

/// A registration has settled when, not coarse any more, it moves by less.
constexpr StepSize kSettledStep = {2e-3, 2e-4};
/// A point this near to its plane agrees with a motion.
constexpr double kAgreement_m = 0.05;

/// How much wider voxels and kernel are in a round of a registration that begins far off:
/// 4, 4, 2, 2, 1, 1, ... times those of the options.
inline double Coarseness(int round) { return std::max(1.0, 4.0 / (1 << (round / 2))); }

inline MapPyramidOptions Coarsened(MapPyramidOptions map, double coarse) {
  map.finest.voxel_size_m *= coarse;
  map.finest.kind = MapKind::kVoxelHash;  // Small maps, and many.
  return map;
}

inline RegistrationNoise CoarsenedNoise(RegistrationOptions registration, double coarse) {
  registration.kernel_m *= coarse;
  return MakeRegistrationNoise(registration);
}

}  // namespace trajlo
