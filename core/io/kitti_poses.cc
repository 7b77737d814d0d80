// SPDX-License-Identifier: MIT
#include "core/io/kitti_poses.h"

#include <Eigen/SVD>
#include <algorithm>

#include "core/io/errors.h"
#include "core/io/finite_pose.h"
#include "core/io/format_text.h"
#include "core/io/meaningful_lines.h"
#include "core/io/number_text.h"

namespace trajlo {
namespace {

constexpr double kProjectAbove = 1e-4;
constexpr double kRefuseAbove = 0.05;

Eigen::Matrix3d NearestRotation(const Eigen::Matrix3d& m) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

}  // namespace

std::vector<Eigen::Affine3d> ParseKittiPoses(const std::filesystem::path& path,
                                             std::string_view text,
                                             std::vector<std::string>* warnings) {
  std::vector<Eigen::Affine3d> poses;
  std::size_t projected = 0;
  double largest_deviation = 0.0;
  MeaningfulLines lines(text);
  for (std::string_view line; lines.Next(&line);) {
    const auto fail = [&](const std::string& found, const std::string& mend) {
      throw InputError(path, "line " + std::to_string(lines.number()) + " " + found, mend);
    };
    Eigen::Affine3d pose = Eigen::Affine3d::Identity();
    for (int i = 0; i < 12; ++i) {
      if (!ParseNumber(TakeWord(&line), &pose.matrix()(i / 4, i % 4))) {
        fail("is not twelve numbers",
             "KITTI's format has the first three rows of the pose on each line.");
      }
    }
    if (!TakeWord(&line).empty()) {
      fail("has more than twelve columns", "Stamps and the row 0 0 0 1 do not belong there.");
    }
    if (!HasFiniteLength(pose.matrix())) {
      fail("has a number that is not finite",
           "Without stamps a pose cannot be left out; write the trajectory in TUM's format.");
    }
    const Eigen::Matrix3d R = pose.linear();
    const double deviation =
        (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
    if (deviation > kRefuseAbove || R.determinant() < 0.0) {
      fail("has no rotation in columns 1-3, 5-7, 9-11", "Is this a file of poses?");
    }
    if (deviation > kProjectAbove) {
      pose.linear() = NearestRotation(R);
      largest_deviation = std::max(largest_deviation, deviation);
      ++projected;
    }
    poses.push_back(pose);
  }
  if (projected > 0 && warnings != nullptr) {
    warnings->push_back(path.string() + ": rotations that are off by up to " +
                        FormatText("%.1g", largest_deviation) + ": " + std::to_string(projected) +
                        "; the nearest rotations are used");
  }
  return poses;
}

}  // namespace trajlo
