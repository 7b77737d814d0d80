// SPDX-License-Identifier: MIT
#include "core/io/trajectory_reader.h"

#include <array>
#include <cmath>
#include <string_view>

#include "core/io/errors.h"
#include "core/io/file_bytes.h"
#include "core/io/finite_pose.h"
#include "core/io/heading_advice.h"
#include "core/io/meaningful_lines.h"
#include "core/io/number_text.h"
#include "core/io/stamp_text.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

enum class LineKind { kPose, kWithoutRotation, kUnusable, kMalformed };

// Of a quaternion whose last number is cut.
constexpr double kCutNorm = 1e-3;

std::size_t CountWords(std::string_view line) {
  std::size_t words = 0;
  while (!TakeWord(&line).empty()) ++words;
  return words;
}

/// `columns` is 8, or 4 without rotations.
LineKind ParseLine(std::string_view line, std::size_t columns, StampedPose* pose) {
  if (CountWords(line) != columns) return LineKind::kMalformed;
  const std::string_view stamp = TakeWord(&line);
  std::array<double, 7> values{0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0};
  for (std::size_t i = 0; i + 1 < columns; ++i) {
    if (!ParseNumber(TakeWord(&line), &values[i])) return LineKind::kMalformed;
  }
  const auto t_ns = ParseDecimalNs(stamp, kNsPerSecond);
  double stamp_number = 0.0;
  if (!t_ns) return ParseNumber(stamp, &stamp_number) ? LineKind::kUnusable : LineKind::kMalformed;

  pose->t_ns = *t_ns;
  pose->has_rotation = columns == 8;
  pose->T_world_body.t = Eigen::Vector3d(values[0], values[1], values[2]);
  pose->T_world_body.q = Eigen::Quaterniond(values[6], values[3], values[4], values[5]);
  if (!HasFiniteLength(pose->T_world_body)) return LineKind::kUnusable;
  if (pose->T_world_body.q.norm() < 1e-6) {
    pose->T_world_body.q.setIdentity();
    pose->has_rotation = false;
    return LineKind::kWithoutRotation;
  }
  return LineKind::kPose;
}

}  // namespace

std::vector<StampedPose> ReadTum(const std::filesystem::path& path,
                                 std::vector<std::string>* warnings) {
  return ParseTum(path, ReadFileBytes(path).view(), warnings);
}

std::vector<StampedPose> ParseTum(const std::filesystem::path& path, std::string_view text,
                                  std::vector<std::string>* warnings) {
  const bool ends_with_line = !text.empty() && text.back() == '\n';
  std::vector<StampedPose> poses, positions;
  std::vector<std::size_t> position_lines;
  const auto warn = [&](std::size_t number, const char* what) {
    if (warnings == nullptr) return;
    warnings->push_back(path.string() + ": line " + std::to_string(number) + " " + what);
  };
  MeaningfulLines lines(text);
  std::size_t columns = 0;
  bool all_are_units = true;
  for (std::string_view line; lines.Next(&line);) {
    if (columns == 0) columns = CountWords(line) == 4 ? 4 : 8;
    StampedPose pose;
    const LineKind kind = ParseLine(line, columns, &pose);
    const bool may_be_cut = lines.at_end() && !ends_with_line;
    const bool is_unit = std::abs(pose.T_world_body.q.norm() - 1.0) < kCutNorm;
    if (kind == LineKind::kPose && may_be_cut && !is_unit && all_are_units && !poses.empty()) {
      warn(lines.number(), "is skipped: its end is missing, as after an interrupted recording");
    } else if (kind == LineKind::kPose) {
      all_are_units = all_are_units && is_unit;
      pose.T_world_body.q.normalize();
      poses.push_back(pose);
    } else if (kind == LineKind::kWithoutRotation) {
      positions.push_back(pose);
      position_lines.push_back(lines.number());
    } else if (kind == LineKind::kUnusable) {
      warn(lines.number(), "is skipped: a number is not finite, or the stamp is in the far future");
    } else if (may_be_cut) {
      warn(lines.number(), "is skipped: it is incomplete, as after an interrupted recording");
    } else {
      throw InputError(
          path, "line " + std::to_string(lines.number()) + " is not 'stamp x y z qx qy qz qw'",
          std::string("A TUM trajectory has eight numbers a line, separated by blanks; positions "
                      "alone have four, 'stamp x y z'.") +
              (poses.empty() && positions.empty() ? HeadingAdvice(line) : ""));
    }
  }
  if (poses.empty() && !positions.empty()) {
    warn(position_lines.front(),
         "and all others have a zero quaternion: positions without rotations, whose angles mean "
         "nothing");
    return positions;
  }
  for (const std::size_t number : position_lines) {
    warn(number, "is skipped: the quaternion is zero");
  }
  return poses;
}

}  // namespace trajlo
