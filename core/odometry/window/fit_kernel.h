// SPDX-License-Identifier: MIT
#pragma once

#include "core/odometry/weights/registration_options.h"
#include "core/odometry/window/window.h"

namespace trajlo {

/// Makes the robust kernel of a window as wide as its points scatter about their planes:
///
///   width = kernel_in_spreads · WeightedPointScatter,   sigma_m <= width <= kernel_m.
///
/// What is an outlier depends on how far the others are off, by the noise of sensor and map. For a
/// newest segment that is predicted badly, see GraduatedKernel.
void FitKernel(const RegistrationOptions& options, Window* window);

}  // namespace trajlo
