// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "core/io/output_file.h"
#include "core/odometry/trajectory/trajectory.h"
#include "manifolds/se3.h"

namespace trajlo {

/// Writes the covariance of control poses, a line each while the run goes on: t_s, then the upper
/// triangle of the 6x6 matrix by rows. It belongs to the right perturbation [rho; theta] of
/// T_world_body (body frame; m², m rad, rad²): T_true = T Exp([rho; theta]). Members throw
/// OutputError.
class CovarianceCsvWriter {
 public:
  explicit CovarianceCsvWriter(const std::filesystem::path& path,
                               IfExists if_exists = IfExists::kFail);

  void Append(const ControlPose& pose, const Matrix6d& covariance);
  void Close() { file_.Close(); }

 private:
  OutputFile file_;
};

}  // namespace trajlo
