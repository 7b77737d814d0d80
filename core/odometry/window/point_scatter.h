// SPDX-License-Identifier: MIT
#pragma once

#include "core/odometry/window/window.h"

namespace trajlo {

/// How far the points of a window lie from their planes at the present poses, as a standard
/// deviation (metres) that outliers do not change:
///
///   1.4826 median_i |nᵀx_i - d_i|
///
/// The median hardly feels one segment in five that is predicted badly. Zero where fewer than 20
/// points are asked, too few to tell.
double PointScatter(const Window& window);

}  // namespace trajlo
