// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "manifolds/eigen_abi.h"

namespace trajlo {

/// The direction from which a point of the map was seen, to a tenth, in twelve bits: four for each
/// coordinate of the unit vector. They are kept in the last bits of the point's own coordinates,
/// which moves it by a micrometre in a metre.
class SeenFrom {
 public:
  /// Of each coordinate.
  static constexpr float kPrecision = 0.1F;

  /// No direction.
  SeenFrom() = default;
  /// `to_sensor` is of any length.
  explicit SeenFrom(const Eigen::Vector3f& to_sensor) {
    const float length = to_sensor.norm();
    if (!(length > 0.0F) || !std::isfinite(length)) return;
    for (int axis = 0; axis < 3; ++axis) {
      steps_[axis] = Rounded(kSteps * to_sensor[axis] / length);
    }
  }
  /// That which a point has with it.
  static SeenFrom Of(float x, float y, float z) {
    SeenFrom seen_from;
    seen_from.steps_ = {StepsIn(x), StepsIn(y), StepsIn(z)};
    return seen_from;
  }

  /// A coordinate of a point that has its part of the direction with it.
  float PutInto(float coordinate, int axis) const {
    const auto code = static_cast<std::uint32_t>(steps_[axis]) & kMask;
    return FromBits((ToBits(coordinate) & ~kMask) | code);
  }

  /// Of length 1, to a tenth; zero if there is none.
  Eigen::Vector3f Direction() const { return steps_.cast<float>() / kSteps; }

 private:
  static constexpr float kSteps = 7.0F;
  static constexpr std::uint32_t kMask = 15;

  /// As lround, without a call.
  static int Rounded(float number) {
    return static_cast<int>(static_cast<double>(number) + std::copysign(0.5, number));
  }
  static std::uint32_t ToBits(float number) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &number, sizeof(bits));
    return bits;
  }
  static float FromBits(std::uint32_t bits) {
    float number = 0.0F;
    std::memcpy(&number, &bits, sizeof(number));
    return number;
  }
  static int StepsIn(float coordinate) {
    const auto code = static_cast<int>(ToBits(coordinate) & kMask);
    return code < 8 ? code : code - 16;
  }

  Eigen::Vector3i steps_ = Eigen::Vector3i::Zero();
};

}  // namespace trajlo
