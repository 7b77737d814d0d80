// SPDX-License-Identifier: MIT
#include "core/config/extrinsics_yaml.h"

#include <cmath>

#include "core/config/yaml_scalars.h"

namespace trajlo {
namespace {

constexpr char kForm[] =
    "expected a list with one transform per LiDAR, each {translation_m: [x, y, z], rotation: [qx, "
    "qy, qz, qw]} or a matrix as a list of 12 or 16 numbers, row by row";

/// Appends the numbers of a list, row by row if it holds lists.
void CollectNumbers(const YAML::Node& node, std::vector<double>* numbers) {
  if (node.IsSequence()) {
    for (const YAML::Node& item : node) CollectNumbers(item, numbers);
    return;
  }
  double number = 0.0;
  if (!node.IsScalar() || !ParseFinite(node.Scalar(), &number)) {
    throw ErrorAt(node, "expected a finite number" +
                            (node.IsScalar() ? ", found '" + node.Scalar() + "'" : std::string()));
  }
  numbers->push_back(number);
}

std::vector<double> Numbers(const YAML::Node& node) {
  std::vector<double> numbers;
  CollectNumbers(node, &numbers);
  return numbers;
}

Eigen::Quaterniond ParseQuaternion(const YAML::Node& node) {
  const std::vector<double> v = Numbers(node);
  if (v.size() != 4) {
    throw ErrorAt(node,
                  "rotation needs 4 numbers [qx, qy, qz, qw], found " + std::to_string(v.size()));
  }
  const Eigen::Quaterniond q(v[3], v[0], v[1], v[2]);
  if (std::abs(q.norm() - 1.0) > 1e-3) {
    throw ErrorAt(node, "rotation must be a unit quaternion [qx, qy, qz, qw], its norm is " +
                            NumberText(q.norm()));
  }
  // One that is normalised already keeps its bits, so that a dumped config loads back unchanged.
  return std::abs(q.squaredNorm() - 1.0) < 1e-15 ? q : q.normalized();
}

/// Throws unless R is orthonormal, to the few digits that calibrations are printed with, and turns
/// without mirroring.
void CheckRotation(const YAML::Node& node, const Eigen::Matrix3d& R) {
  const double error = (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  const double determinant = R.determinant();
  if (error <= 1e-3 && determinant > 0.0) return;
  const std::string why = error > 1e-3
                              ? "its columns are not orthogonal and of length 1, RᵀR "
                                "differs from the identity by " +
                                    NumberText(error)
                              : "it mirrors, its determinant is " + NumberText(determinant);
  throw ErrorAt(node, "the 3x3 part of the matrix is not a rotation: " + why);
}

SE3 ParseMatrix(const YAML::Node& node) {
  const std::vector<double> v = Numbers(node);
  if (v.size() != 12 && v.size() != 16) {
    throw ErrorAt(node, "a matrix needs 3 or 4 rows of 4 numbers, found " +
                            std::to_string(v.size()) + " numbers");
  }
  const bool has_last_row = v.size() == 16;
  if (has_last_row && (v[12] != 0.0 || v[13] != 0.0 || v[14] != 0.0 || v[15] != 1.0)) {
    throw ErrorAt(node, "the last row of the matrix must be 0 0 0 1; numbers go row by row");
  }
  Eigen::Matrix3d R;
  Eigen::Vector3d t;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) R(row, column) = v[4 * row + column];
    t[row] = v[4 * row + 3];
  }
  CheckRotation(node, R);
  return {Eigen::Quaterniond(R).normalized(), t};
}

SE3 ParseTransform(const YAML::Node& node) {
  if (node.IsSequence()) return ParseMatrix(node);
  if (!node.IsMap()) throw ErrorAt(node, kForm);
  SE3 T;
  for (const auto& entry : node) {
    const std::string& name = entry.first.Scalar();
    if (name == "translation_m") {
      const std::vector<double> v = Numbers(entry.second);
      if (v.size() != 3) {
        throw ErrorAt(entry.second,
                      "translation_m needs 3 numbers [x, y, z], found " + std::to_string(v.size()));
      }
      T.t = Eigen::Vector3d(v[0], v[1], v[2]);
    } else if (name == "rotation") {
      T.q = ParseQuaternion(entry.second);
    } else if (name == "matrix" && node.size() == 1) {
      T = ParseMatrix(entry.second);
    } else {
      throw ErrorAt(entry.first, "unexpected '" + name + "'; " + kForm);
    }
  }
  return T;
}

std::string ListText(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "[" : ", ") + NumberText(value);
  return text + "]";
}

}  // namespace

std::vector<SE3> ParseExtrinsics(const YAML::Node& node) {
  const bool is_single =
      node.IsMap() || (node.IsSequence() && node.size() > 0 && node[0].IsScalar());
  if (is_single) return {ParseTransform(node)};
  if (!node.IsSequence()) throw ErrorAt(node, kForm);
  std::vector<SE3> extrinsics;
  for (const YAML::Node& item : node) extrinsics.push_back(ParseTransform(item));
  return extrinsics;
}

std::string ExtrinsicText(const SE3& T) {
  return "{translation_m: " + ListText({T.t.x(), T.t.y(), T.t.z()}) +
         ", rotation: " + ListText({T.q.x(), T.q.y(), T.q.z(), T.q.w()}) + "}";
}

}  // namespace trajlo
