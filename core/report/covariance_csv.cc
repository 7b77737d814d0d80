// SPDX-License-Identifier: MIT
#include "core/report/covariance_csv.h"

#include <string>

#include "core/io/stamp_text.h"
#include "core/report/csv_row.h"

namespace trajlo {
namespace {

constexpr const char* kAxes[] = {"rho_x", "rho_y", "rho_z", "theta_x", "theta_y", "theta_z"};

CsvRow MakeRow(const ControlPose& pose, const Matrix6d& covariance) {
  CsvRow row;
  row.Add("t_s", FormatSeconds(pose.t_ns));
  for (int i = 0; i < 6; ++i) {
    for (int j = i; j < 6; ++j) {
      const std::string name = std::string(kAxes[i]) + "__" + kAxes[j];
      row.Add(name.c_str(), covariance(i, j));
    }
  }
  return row;
}

}  // namespace

CovarianceCsvWriter::CovarianceCsvWriter(const std::filesystem::path& path, IfExists if_exists)
    : file_(path, if_exists) {
  file_.Write(MakeRow({}, Matrix6d::Zero()).Names());
}

void CovarianceCsvWriter::Append(const ControlPose& pose, const Matrix6d& covariance) {
  file_.Write(MakeRow(pose, covariance).Values());
}

}  // namespace trajlo
