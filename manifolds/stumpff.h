// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace trajlo {

/// The Stumpff functions c_n(x) = sum_k (-1)^k x^(2k) / (2k + n)!, entire in x², so that every
/// coefficient of SO(3) and SE(3) is a polynomial in them and no formula divides by an angle:
///
///   c0 = cos x, c1 = sin x / x, c2 = (1 - cos x)/x², c3 = (x - sin x)/x³,
///   c_n = 1/n! - x² c_{n+2}.
///
/// Below x = 1 the series of c4 and c5 are summed (9 terms, or 5 below 0.1: the rest is below
/// 1e-17) and the others follow by the recurrence, without a single trigonometric call; above, it
/// runs the other way.
///
/// Source: K. Stumpff, Himmelsmechanik I, 1959; used here as a common basis for the coefficients of
/// T. Barfoot, State Estimation for Robotics, 2017, sections 7.1 and 8.1.5.
template <typename T>
struct StumpffSeries {
  T c0, c1, c2, c3, c4, c5;

  /// The series branch, for x² <= `largest` <= 1; T may be a vector of lanes. Few terms are enough
  /// for most segments, which turn little.
  explicit StumpffSeries(const T& s, double largest = 1.0) {
    // Horner form: c_n = 1/n! (1 - s/((n+1)(n+2)) (1 - s/((n+3)(n+4)) (...))).
    c4 = 1.0 - s * (1.0 / 132);
    c5 = 1.0 - s * (1.0 / 156);
    if (largest > 0.01) {
      c4 = 1.0 - s * (1.0 / 380);
      for (const double r : {1.0 / 306, 1.0 / 240, 1.0 / 182, 1.0 / 132}) c4 = 1.0 - s * r * c4;
      c5 = 1.0 - s * (1.0 / 420);
      for (const double r : {1.0 / 342, 1.0 / 272, 1.0 / 210, 1.0 / 156}) c5 = 1.0 - s * r * c5;
    }
    for (const double r : {1.0 / 90, 1.0 / 56, 1.0 / 30}) c4 = 1.0 - s * r * c4;
    for (const double r : {1.0 / 110, 1.0 / 72, 1.0 / 42}) c5 = 1.0 - s * r * c5;
    c4 = c4 * (1.0 / 24);
    c5 = c5 * (1.0 / 120);
    c3 = 1.0 / 6 - s * c5;
    c2 = 1.0 / 2 - s * c4;
    c1 = 1.0 - s * c3;
    c0 = 1.0 - s * c2;
  }

 protected:
  StumpffSeries() = default;
};

/// The Stumpff functions at any x, given x².
struct Stumpff : StumpffSeries<double> {
  explicit Stumpff(double x_squared) {
    const double s = x_squared;
    if (s < 1.0) {
      StumpffSeries<double>::operator=(StumpffSeries<double>(s));
      return;
    }
    const double x = std::sqrt(s);
    c0 = std::cos(x);
    c1 = std::sin(x) / x;
    c2 = (1.0 - c0) / s;
    c3 = (1.0 - c1) / s;
    c4 = (0.5 - c2) / s;
    c5 = (1.0 / 6 - c3) / s;
  }
};

}  // namespace trajlo
