// SPDX-License-Identifier: MIT
#include "core/io/trajectory_file.h"

#include <algorithm>
#include <system_error>

#include "core/io/errors.h"
#include "core/io/euroc_csv.h"
#include "core/io/file_bytes.h"
#include "core/io/format_text.h"
#include "core/io/heading_advice.h"
#include "core/io/kitti_poses.h"
#include "core/io/meaningful_lines.h"
#include "core/io/number_text.h"
#include "core/io/random_access_file.h"
#include "core/io/stamp_text.h"
#include "core/io/trajectory_reader.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

// A file full of the same defect is described by its first lines.
constexpr std::size_t kWarningsPerFile = 3;

/// Blanks between the columns, and in some of them a comma in place of a point.
bool HasDecimalCommas(std::string_view line) {
  std::size_t words = 0, with_comma = 0;
  for (std::string_view word = TakeWord(&line); !word.empty(); word = TakeWord(&line)) {
    ++words;
    const std::size_t comma = word.find(',');
    if (comma == std::string_view::npos) continue;
    if (comma == 0 || comma + 1 == word.size() || comma != word.rfind(',')) return false;
    ++with_comma;
  }
  return words > 1 && with_comma > 0;
}

TrajectoryFormat Detect(const std::filesystem::path& path, std::string_view text) {
  MeaningfulLines lines(text);
  std::string_view line;
  if (!lines.Next(&line)) return TrajectoryFormat::kTum;
  const std::string where = "line " + std::to_string(lines.number());
  if (line.find(',') != std::string_view::npos) {
    std::string_view stamp = line.substr(0, line.find(','));
    if (AllDigits(stamp) && HasDecimalCommas(line)) {
      throw InputError(path, where + " has decimal commas",
                       "Numbers need a point ('0.5', not '0,5').");
    }
    stamp = TakeWord(&stamp);
    double number = 0.0;
    // With a fraction these would be seconds, and nobody could tell the order of the quaternion.
    if (AllDigits(stamp) || !ParseNumber(stamp, &number)) return TrajectoryFormat::kEuroc;
    throw InputError(path, where + " is separated by commas but has no stamp in nanoseconds",
                     "EuRoC's csv begins with whole nanoseconds; TUM's format has blanks "
                     "between its columns.");
  }
  const std::string advice = HeadingAdvice(line);
  std::size_t columns = 0;
  while (!TakeWord(&line).empty()) ++columns;
  if (columns == 8 || columns == 4) return TrajectoryFormat::kTum;
  if (columns == 12) return TrajectoryFormat::kKitti;
  throw InputError(
      path, where + " has " + std::to_string(columns) + " columns",
      std::string("Trajectories have 8 (TUM: stamp x y z qx qy qz qw), 4 (stamp x y z) or 12 "
                  "(KITTI: the pose's first three rows), or are EuRoC's csv.") +
          advice);
}

/// A stamp in ns, us or ms in a file that should have seconds is the usual mistake.
void CheckStampUnit(const std::filesystem::path& path, std::string_view text) {
  MeaningfulLines lines(text);
  std::string_view line;
  if (!lines.Next(&line)) return;
  const std::string_view stamp = TakeWord(&line);
  if (!AllDigits(stamp.substr(0, stamp.find('.'))) || ParseDecimalNs(stamp, kNsPerSecond)) return;
  throw InputError(path,
                   "the stamp " + std::string(stamp) + " of line " +
                       std::to_string(lines.number()) + " would be in the far future",
                   "TUM's format has stamps in seconds; these look like ns, us or ms.");
}

/// Bags hold ground truth, too, but are no trajectories. They can be large, so that only their
/// first bytes are read.
void RefuseBag(const std::filesystem::path& path) {
  std::error_code error;
  bool is_bag = std::filesystem::is_regular_file(path / "metadata.yaml", error);
  if (std::filesystem::is_regular_file(path, error)) {
    const FileBytes begin = RandomAccessFile(path).Read(0, 16);
    for (const std::string_view magic : {"#ROSBAG V", "\x89MCAP", "SQLite format 3"}) {
      is_bag = is_bag || begin.view().substr(0, magic.size()) == magic;
    }
  }
  if (!is_bag) return;
  throw InputError(path, "this is a bag, not a file of poses",
                   "Take the poses of a topic out of it: trajlo_convert " + path.string() +
                       " truth.tum --poses=TOPIC (trajlo_info lists the topics).");
}

void Condense(std::size_t from, std::vector<std::string>* warnings) {
  if (warnings->size() <= from + kWarningsPerFile) return;
  const std::size_t more = warnings->size() - from - kWarningsPerFile;
  warnings->resize(from + kWarningsPerFile);
  warnings->back() += " (and " + CountOf(more, "more line") + ")";
}

}  // namespace

const char* TrajectoryFormatName(TrajectoryFormat format) {
  switch (format) {
    case TrajectoryFormat::kTum:
      return "tum";
    case TrajectoryFormat::kKitti:
      return "kitti";
    case TrajectoryFormat::kEuroc:
      return "euroc";
    case TrajectoryFormat::kAuto:
      break;
  }
  return "auto";
}

std::optional<TrajectoryFormat> ParseTrajectoryFormat(std::string_view name) {
  for (const TrajectoryFormat format : {TrajectoryFormat::kAuto, TrajectoryFormat::kTum,
                                        TrajectoryFormat::kKitti, TrajectoryFormat::kEuroc}) {
    if (name == TrajectoryFormatName(format)) return format;
  }
  return {};
}

TrajectoryFile ReadTrajectory(const std::filesystem::path& path, TrajectoryFormat format,
                              std::vector<std::string>* warnings) {
  std::error_code error;
  if (std::filesystem::is_regular_file(path / "trajectory.tum", error)) {
    return ReadTrajectory(path / "trajectory.tum", format, warnings);
  }
  RefuseBag(path);
  const FileBytes bytes = ReadFileBytes(path);
  const std::size_t earlier_warnings = warnings->size();
  TrajectoryFile file;
  file.format = format == TrajectoryFormat::kAuto ? Detect(path, bytes.view()) : format;
  std::vector<StampedPose> poses;
  if (file.format == TrajectoryFormat::kKitti) {
    file.T_world_body = ParseKittiPoses(path, bytes.view(), warnings);
  } else if (file.format == TrajectoryFormat::kEuroc) {
    poses = ParseEurocCsv(path, bytes.view(), warnings);
  } else {
    CheckStampUnit(path, bytes.view());
    poses = ParseTum(path, bytes.view(), warnings);
  }
  const auto has_rotation = [](const StampedPose& pose) { return pose.has_rotation; };
  file.has_rotations = poses.empty() || std::any_of(poses.begin(), poses.end(), has_rotation);
  for (const StampedPose& pose : poses) {
    file.t_ns.push_back(pose.t_ns);
    file.T_world_body.emplace_back(Eigen::Translation3d(pose.T_world_body.t) * pose.T_world_body.q);
  }
  Condense(earlier_warnings, warnings);
  if (file.T_world_body.empty()) {
    throw InputError(path, "holds no poses", "Is the file complete, and is it a trajectory?");
  }
  return file;
}

}  // namespace trajlo
