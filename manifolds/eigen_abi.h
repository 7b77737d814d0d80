// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

// Eigen's compiler flags change the layout of its types and the way they allocate: with AVX, an
// Eigen::Quaterniond is aligned to 32 bytes in place of 16, and a matrix that one side allocates
// cannot be freed by the other. Programs and libraries that disagree crash, or read wrong numbers.
// The trajlo libraries are always built the way Eigen is by default on x86-64 and ARM64 (the way
// Debian builds Ceres), for any -march. Whoever includes their headers must agree:
static_assert(
    EIGEN_MAX_STATIC_ALIGN_BYTES == 16 &&
        (EIGEN_DEFAULT_ALIGN_BYTES == 0 || EIGEN_MALLOC_ALREADY_ALIGNED),
    "Here Eigen lays out or allocates its types otherwise than in the trajlo libraries. That comes "
    "from -march=native, -mavx, EIGEN_DONT_ALIGN, EIGEN_DONT_VECTORIZE or a sanitizer. Leave it "
    "out, or compile this target with -DEIGEN_DONT_VECTORIZE -DEIGEN_MAX_STATIC_ALIGN_BYTES=16");
