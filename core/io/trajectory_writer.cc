// SPDX-License-Identifier: MIT
#include "core/io/trajectory_writer.h"

#include <charconv>
#include <string>

#include "core/io/stamp_text.h"

namespace trajlo {
namespace {

constexpr int kDecimals = 9;

/// to_chars, not printf: a locale must not put commas into numbers.
void AppendNumber(double value, std::chars_format format, std::string* line) {
  char text[400];  // Large enough for the largest double in fixed notation.
  const auto [end, error] = std::to_chars(text, text + sizeof(text), value, format, kDecimals);
  const std::string_view number(text, static_cast<std::size_t>(end - text));
  // "-0.000000000" says nothing that "0.000000000" does not.
  const bool minus_zero =
      format == std::chars_format::fixed && number.find_first_not_of("-0.") == number.npos;
  line->append(minus_zero && number.front() == '-' ? number.substr(1) : number);
}

}  // namespace

TumWriter::TumWriter(const std::filesystem::path& path, IfExists if_exists)
    : file_(path, if_exists) {}

void TumWriter::Append(std::int64_t t_ns, const SE3& T_world_body) {
  std::string line = FormatSeconds(t_ns);
  const Eigen::Vector3d& t = T_world_body.t;
  const Eigen::Quaterniond& q = T_world_body.q;
  for (const double value : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}) {
    line += ' ';
    AppendNumber(value, std::chars_format::fixed, &line);
  }
  line += '\n';
  file_.Write(line);
}

KittiWriter::KittiWriter(const std::filesystem::path& path, IfExists if_exists)
    : file_(path, if_exists) {}

void KittiWriter::Append(const SE3& T_world_body) {
  Eigen::Matrix<double, 3, 4> rows;
  rows << T_world_body.q.toRotationMatrix(), T_world_body.t;
  std::string line;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      if (!line.empty()) line += ' ';
      AppendNumber(rows(row, column), std::chars_format::scientific, &line);
    }
  }
  line += '\n';
  file_.Write(line);
}

}  // namespace trajlo
