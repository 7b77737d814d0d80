// SPDX-License-Identifier: MIT
#pragma once

#include "core/odometry/weights/registration_options.h"
#include "core/odometry/window/window.h"

namespace trajlo {

/// Makes the robust kernels of a window as wide as its points scatter about their planes, for each
/// axis a according to the points that hold it:
///
///   width_a = kernel_in_spreads · 1.4826 median |sqrt(weight_i) (n_iᵀx_i - d_i)|,
///
/// within sigma_m and 3 kernel_m; the median over the points whose normal is nearest to a, in
/// which each counts by its weight.
///
/// What is an outlier depends on how far the others are off. But on a motorway nearly all points
/// are on the road, and fit it whatever the speed is; of the few that tell the speed, those on
/// signs and posts, a width that suits the road makes outliers as soon as the estimate lags by its
/// width, and nothing brings it back. So each direction has a width of its own, by the scatter of
/// where its information is. The axes are the principal ones of sum w n nᵀ; see
/// Window::kernel_axes. For a newest segment that is predicted badly, see GraduatedKernel.
void FitKernel(const RegistrationOptions& options, Window* window);

}  // namespace trajlo
