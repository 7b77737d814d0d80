// SPDX-License-Identifier: MIT
#include "core/export/run_result.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "core/export/csv_table.h"
#include "core/io/errors.h"
#include "core/io/stamp_text.h"
#include "core/io/trajectory_reader.h"
#include "core/report/result_folder.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

/// Where a run came to its end, whether or not all went well.
bool ReadAllOfIt(int exit_code) { return exit_code == 0 || exit_code == 3 || exit_code == 4; }

/// Where the recording was, and as the command line named it if it is not there any more.
std::vector<std::string> InputsOf(const Json& input) {
  const auto paths = input.at("paths").get<std::vector<std::string>>();
  const auto absolute = input.value("absolute_paths", std::vector<std::string>());
  const bool all_there =
      !absolute.empty() && std::all_of(absolute.begin(), absolute.end(), [](const auto& path) {
        std::error_code error;
        return fs::exists(path, error);
      });
  return all_there ? absolute : paths;
}

void TakeSummary(const fs::path& path, RunResult* result) {
  std::ifstream file(path);
  try {
    const Json json = Json::parse(file);
    result->inputs = InputsOf(json.at("input"));
    const Json& code = json.at("exit").at("code");
    if (code.is_number() && ReadAllOfIt(code.get<int>())) {
      result->scans_read = json.at("input").at("scans").at("read").get<std::size_t>();
    }
    const Json& lost_at_s = json.at("result").at("lost_at_s");
    if (lost_at_s.is_string()) {
      result->lost_at_ns = ParseDecimalNs(lost_at_s.get<std::string>(), kNsPerSecond);
    }
  } catch (const Json::exception& error) {
    throw InputError(path, std::string("this is not the summary of a run: ") + error.what(),
                     "Give a folder that trajlo_run wrote.");
  }
}

/// The flags of control poses, by time: each window says those of its newest one.
std::map<std::int64_t, unsigned> ReadFlags(const fs::path& path) {
  std::map<std::int64_t, unsigned> flags;
  const CsvTable table(path);
  const std::size_t end = table.ColumnOf("end_s"), flag = table.ColumnOf("flags");
  for (std::size_t row = 0; row < table.rows(); ++row) {
    flags[table.SecondsAsNs(row, end)] = static_cast<unsigned>(table.Number(row, flag));
  }
  return flags;
}

std::map<std::int64_t, Matrix6d> ReadCovariances(const fs::path& path) {
  std::map<std::int64_t, Matrix6d> covariances;
  const CsvTable table(path);
  const std::size_t time = table.ColumnOf("t_s");
  const std::size_t first = table.ColumnOf("rho_x__rho_x");
  for (std::size_t row = 0; row < table.rows(); ++row) {
    Matrix6d& covariance = covariances[table.SecondsAsNs(row, time)];
    std::size_t column = first;
    for (int i = 0; i < 6; ++i) {
      for (int j = i; j < 6; ++j, ++column) {
        covariance(i, j) = covariance(j, i) = table.Number(row, column);
      }
    }
  }
  return covariances;
}

void TakePoses(const fs::path& path, const std::map<std::int64_t, unsigned>& flags,
               const ResultOptions& options, RunResult* result) {
  std::size_t estimated = 0;
  for (const StampedPose& pose : ReadTum(path)) {
    const bool is_lost = result->lost_at_ns && pose.t_ns >= *result->lost_at_ns;
    if (is_lost && !options.keep_lost) {
      ++result->poses_left_out;
      continue;
    }
    const auto found = flags.find(pose.t_ns);
    estimated += found != flags.end() ? 1 : 0;
    try {
      result->trajectory.Append(
          {pose.t_ns, pose.T_world_body, found == flags.end() ? 0U : found->second});
    } catch (const std::invalid_argument&) {
      throw InputError(
          path,
          "the pose at " + FormatSeconds(pose.t_ns) + " s does not come after the one before it",
          "Give a folder that trajlo_run wrote.");
    }
  }
  if (result->trajectory.empty()) {
    throw InputError(path,
                     result->poses_left_out > 0
                         ? "the estimator was lost from the start: no pose is to be trusted"
                         : "there is no pose",
                     result->poses_left_out > 0 ? "--keep_lost takes them all the same." : "");
  }
  // No window ends at the first pose, nor where a pause begins and ends; a short run has none.
  result->has_control_poses = flags.empty() || 2 * estimated >= result->trajectory.poses().size();
}

}  // namespace

bool IsRunResult(const fs::path& folder) {
  const ResultFolder files(folder);
  std::error_code error;
  return fs::is_regular_file(files.trajectory(), error) &&
         fs::is_regular_file(files.summary(), error);
}

std::string RunShortcoming(const fs::path& folder) {
  std::ifstream stream(ResultFolder(folder).summary());
  const Json json = Json::parse(stream, nullptr, false);
  if (!json.is_object() || !json.contains("exit") || !json["exit"].is_object()) return "";
  const Json& exit = json["exit"];
  const std::string reason = exit.value("reason", ""), message = exit.value("message", "");
  if (reason.empty() || reason == "ok") return "";
  if (reason == "running") return "the run was killed or is still running";
  return message.empty() ? "the run ended early (" + reason + ")" : message;
}

RunResult ReadRunResult(const fs::path& folder, const ResultOptions& options) {
  const ResultFolder files(folder);
  RunResult result;
  TakeSummary(files.summary(), &result);
  result.unknown_keys = LoadRecordedConfig(files.config(), &result.config);
  std::error_code error;
  if (fs::exists(files.rig(), error)) LoadConfigFile(files.rig(), &result.config);
  TakePoses(files.trajectory(), ReadFlags(files.windows()), options, &result);
  if (fs::exists(files.covariance(), error)) {
    result.covariances = ReadCovariances(files.covariance());
  }
  return result;
}

}  // namespace trajlo
