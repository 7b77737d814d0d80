// SPDX-License-Identifier: MIT
#include "core/io/euroc_csv.h"

#include <algorithm>
#include <array>

#include "core/io/ascii_table.h"
#include "core/io/errors.h"
#include "core/io/finite_pose.h"
#include "core/io/format_text.h"
#include "core/io/meaningful_lines.h"
#include "core/io/number_text.h"
#include "core/io/stamp_text.h"

namespace trajlo {
namespace {

/// Takes the next field off a line of csv, without the blanks around it; nothing of one with blanks
/// inside, which is no number.
std::string_view TakeField(std::string_view* line) {
  const std::size_t comma = line->find(',');
  std::string_view field = line->substr(0, comma);
  line->remove_prefix(comma == std::string_view::npos ? line->size() : comma + 1);
  const std::string_view word = TakeWord(&field);
  return TakeWord(&field).empty() ? word : std::string_view();
}

/// Whether a heading names w as the last of the quaternion, and not as the first.
bool HasScalarLast(std::string_view heading) {
  const auto names_w = [](std::string_view field) {
    return field.find_first_of("wW") != std::string_view::npos;
  };
  std::array<std::string_view, 8> fields;
  for (std::string_view& field : fields) {
    const std::size_t comma = heading.find(',');
    field = heading.substr(0, comma);
    heading.remove_prefix(comma == std::string_view::npos ? heading.size() : comma + 1);
  }
  return !names_w(fields[4]) && names_w(fields[7]);
}

void CheckHeading(const std::filesystem::path& path, std::string_view heading) {
  if (!HasScalarLast(heading)) return;
  throw InputError(path, "the heading has w last in the quaternion, and EuRoC's csv has it first",
                   "Order the columns as 't_ns,x,y,z,qw,qx,qy,qz', or write TUM's format, 'stamp x "
                   "y z qx qy qz qw' with stamps in seconds and blanks between the columns.");
}

/// A comment before the first row is a heading, too, as EuRoC's own files have it.
void CheckLeadingComments(const std::filesystem::path& path, std::string_view text) {
  for (std::string_view line; TakeLine(&text, &line);) {
    const std::size_t begin = line.find_first_not_of(" \t\r\xEF\xBB\xBF");
    if (begin == std::string_view::npos) continue;
    if (line[begin] != '#') return;
    CheckHeading(path, line.substr(begin + 1));
  }
}

/// No truth has poses as often as this. Stamps in seconds, ms or us give less if taken as ns.
constexpr double kShortestPeriod_ns = 2e5;

void CheckStampUnit(const std::filesystem::path& path, const std::vector<StampedPose>& poses) {
  if (poses.size() < 2) return;
  const auto [first, last] = std::minmax_element(
      poses.begin(), poses.end(),
      [](const StampedPose& a, const StampedPose& b) { return a.t_ns < b.t_ns; });
  const double step_ns =
      static_cast<double>(last->t_ns - first->t_ns) / static_cast<double>(poses.size() - 1);
  const bool is_one_pose_twice = step_ns == 0.0 && poses.size() == 2;
  if (step_ns >= kShortestPeriod_ns || is_one_pose_twice) return;
  throw InputError(
      path, FormatText("the stamps are not in nanoseconds: they would be %.2g ns apart", step_ns),
      "EuRoC's csv, 't_ns,x,y,z,qw,qx,qy,qz', has whole nanoseconds. Stamps in "
      "seconds need TUM's format, 'stamp x y z qx qy qz qw' with blanks between the "
      "columns.");
}

}  // namespace

std::vector<StampedPose> ParseEurocCsv(const std::filesystem::path& path, std::string_view text,
                                       std::vector<std::string>* warnings) {
  CheckLeadingComments(path, text);
  std::vector<StampedPose> poses;
  MeaningfulLines lines(text);
  bool first = true;
  for (std::string_view line; lines.Next(&line); first = false) {
    const std::string_view whole_line = line;
    const std::string_view stamp = TakeField(&line);
    double stamp_number = 0.0;
    bool well_formed = ParseNumber(stamp, &stamp_number);
    if (first && !well_formed) {
      CheckHeading(path, whole_line);
      continue;
    }
    std::array<double, 7> v{};
    for (double& value : v) well_formed = well_formed && ParseNumber(TakeField(&line), &value);
    if (!well_formed) {
      throw InputError(
          path, "line " + std::to_string(lines.number()) + " is not 't_ns,x,y,z,qw,qx,qy,qz'",
          "EuRoC's csv has at least these eight columns, separated by commas.");
    }
    StampedPose pose;
    const auto t_ns = ParseDecimalNs(stamp, 1);
    pose.T_world_body.t = Eigen::Vector3d(v[0], v[1], v[2]);
    pose.T_world_body.q = Eigen::Quaterniond(v[3], v[4], v[5], v[6]);
    if (!t_ns || !HasFiniteLength(pose.T_world_body) || pose.T_world_body.q.norm() < 1e-6) {
      if (warnings != nullptr) {
        warnings->push_back(path.string() + ": line " + std::to_string(lines.number()) +
                            " is skipped: a number is not finite or the quaternion is zero");
      }
      continue;
    }
    pose.t_ns = *t_ns;
    pose.T_world_body.q.normalize();
    poses.push_back(pose);
  }
  CheckStampUnit(path, poses);
  return poses;
}

}  // namespace trajlo
