// SPDX-License-Identifier: MIT
#pragma once

#include "core/odometry/weights/registration_options.h"
#include "core/odometry/window/window.h"

namespace trajlo {

/// Makes the robust kernel of a window as wide as the distances of its points are spread:
///
///   s_i = sqrt(weight_i) |nᵀx_i - d_i|  at the present poses, of all segments,
///   width = kernel_in_spreads · 1.4826 median(s_i),   sigma_m <= width <= kernel_m.
///
/// What is an outlier depends on how far the others are off, by the noise of sensor and map. The
/// median hardly feels one segment in five that is predicted badly; for that one, see
/// GraduatedKernel. (1.4826 median is the standard deviation if s is normal: P. Huber, Robust
/// Statistics, 1981.)
void FitKernel(const RegistrationOptions& options, Window* window);

}  // namespace trajlo
