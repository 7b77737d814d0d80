// SPDX-License-Identifier: MIT
// Simulates LiDAR recordings with exact ground truth. See --help.
#include <gflags/gflags.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "apps/command.h"
#include "apps/interrupt.h"
#include "apps/simulate/write_recording.h"
#include "apps/usage_error.h"
#include "core/io/conversion/scan_bag_writer.h"
#include "core/options/did_you_mean.h"
#include "core/options/edit_distance.h"
#include "core/simulation/scenario.h"
#include "core/simulation/scenario_parameters.h"
#include "core/simulation/simulator.h"

DEFINE_string(scenario, "", "the same as the argument: what to simulate");
DEFINE_string(output, "", "-o: the folder to write; it must be new or empty");
DEFINE_double(duration_s, 0.0, "length of the recording; 0 keeps the scenario's own");
DEFINE_int64(seed, 0,
             "seed of noise, shaking and details of the scene; 0 keeps the scenario's own");
DEFINE_string(set, "", "parameters to change: key=value; may be repeated");
DEFINE_int32(threads, 0, "0 for all processors; the recording does not depend on it");
DEFINE_bool(list, false, "list the scenarios and stop");
DEFINE_bool(list_parameters, false,
            "list the parameters of the scenario with their values and stop");
DEFINE_string(format, "pcd", "pcd: a folder of scans; bag: recording.bag for ROS 1");
DEFINE_string(
    bag_layout, "",
    "of the points in the bag: ouster, velodyne or livox; empty: as each sensor's driver");
DEFINE_string(bag_compression, "none", "of the bag: none, lz4 or bz2");
DEFINE_bool(overwrite, false, "replace what is in the output folder");

namespace {

using trajlo::ExitCode;
using trajlo::UsageError;
using trajlo::simulation::Scenario;

constexpr char kHelp[] = R"(Simulates a LiDAR recording with exact ground truth.

  trajlo_simulate --list
      the scenarios, one per line
  trajlo_simulate hall_os1_16 -o hall
      writes hall/scans/*.pcd, hall/timestamps.txt, hall/truth.tum, hall/scenario.yaml, and
      hall/rig.yaml with the true extrinsics, for trajlo_run hall -o result -c hall/rig.yaml
  trajlo_simulate hall_os1_16 -o hall2 --duration_s=30 --seed=2
      another hall, another flight, other noise
  trajlo_simulate hall_os1_16 --list_parameters
      everything that --set can change, with its value
  trajlo_simulate hall_os1_16 -o noisy --set lidar.range_sigma_m=0.05 --set motion.speed_mps=5
      `lidar.` is every LiDAR of the rig, `lidar0.` the first
  trajlo_simulate hall_os1_16 -o again --duration_s=10 \
      --set motion.kind=replay,motion.replay_file=run.tum
      flies the first 10 s of your own trajectory through the hall
  trajlo_simulate hall_os1_16 -o broken --set faults.dropped_scan_fraction=0.05
      with one of 20 scans missing
  trajlo_simulate hall_os1_16 -o bagged --format=bag --bag_compression=lz4
      bagged/recording.bag in place of the scans, with the truth on /truth

Flags:
  -o, --output=FOLDER       where the recording goes: a folder that is new or empty
  --overwrite               replace the recording that is in the folder
  --scenario=NAME           the same as the argument
  --set=KEY=VALUE           change parameters; may be repeated
  --duration_s=S            the length of the recording; 0 keeps the scenario's own
  --seed=N                  of noise, shaking and details of the scene; 0 keeps the scenario's own
  --threads=N               0 for all processors; the recording does not depend on it
  --format=pcd|bag          a folder of scans, or recording.bag for ROS 1
  --bag_layout=ouster|velodyne|livox   of the points in the bag; each sensor's driver's by default
  --bag_compression=none|lz4|bz2
  --list, --list_parameters
  -h, --help, --version

Exit codes: 0 done, 1 wrong usage, 5 output not writable, 6 out of memory or a defect of the program,
130 interrupted; what was simulated so far is a shorter recording.
)";

/// `key=value,key=value`. A piece without '=' belongs to the value before it, which lets a value
/// hold commas: lidar0.T_body_lidar=0,0,0.1,0,0,0,1,seed=2.
void ApplySettings(const std::string& settings, Scenario* scenario) {
  std::vector<std::pair<std::string, std::string>> pairs;
  std::istringstream stream(settings);
  for (std::string piece; std::getline(stream, piece, ',');) {
    const std::size_t equals = piece.find('=');
    if (equals != std::string::npos) {
      pairs.emplace_back(piece.substr(0, equals), piece.substr(equals + 1));
    } else if (!pairs.empty()) {
      pairs.back().second += "," + piece;
    } else {
      throw UsageError("--set: expected key=value, got '" + piece + "'");
    }
  }
  std::set<std::string> seen;
  for (const auto& [key, value] : pairs) {
    if (!seen.insert(key).second) throw UsageError("--set: '" + key + "' is set twice");
  }
  trajlo::simulation::SetParameters(scenario, std::move(pairs));
}

/// The name of the scenario: --scenario or the argument. Throws if there is no such scenario; empty
/// if none is given.
std::string ScenarioName(const trajlo::CommandLine& line) {
  if (!FLAGS_scenario.empty() || line.arguments.size() > 1) RequireNoArguments(line);
  const std::string name = line.arguments.empty() ? FLAGS_scenario : line.arguments.front();
  const std::vector<std::string> names = trajlo::simulation::ScenarioNames();
  if (name.empty() || std::find(names.begin(), names.end(), name) != names.end()) return name;
  const std::string mend = trajlo::Suggestion(trajlo::NearestOrLonger(name, names));
  throw UsageError("there is no scenario '" + name + "'" +
                   (mend.empty() ? "; --list shows them" : mend));
}

void CheckNumbers() {
  using trajlo::simulation::kLongestDuration_s;
  using trajlo::simulation::kShortestDuration_s;
  if (!(FLAGS_duration_s == 0.0 ||
        (FLAGS_duration_s >= kShortestDuration_s && FLAGS_duration_s <= kLongestDuration_s))) {
    std::ostringstream text;
    text << "--duration_s: must be between " << kShortestDuration_s << " and " << kLongestDuration_s
         << " s, or 0, found " << FLAGS_duration_s;
    throw UsageError(text.str());
  }
  if (FLAGS_seed < 0) {
    throw UsageError("--seed: must not be negative, found " + std::to_string(FLAGS_seed));
  }
  if (FLAGS_threads < 0) {
    throw UsageError("--threads: must not be negative, found " + std::to_string(FLAGS_threads));
  }
}

Scenario ScenarioFromFlags(const std::string& name) {
  if (name.empty()) {
    throw UsageError("name a scenario (--list shows them): trajlo_simulate SCENARIO -o FOLDER");
  }
  Scenario scenario = trajlo::simulation::MakeScenario(name);
  CheckNumbers();
  if (FLAGS_duration_s > 0.0) scenario.duration_s = FLAGS_duration_s;
  if (FLAGS_seed > 0) scenario.seed = static_cast<std::uint64_t>(FLAGS_seed);
  ApplySettings(FLAGS_set, &scenario);
  const bool same = (FLAGS_duration_s == 0.0 || scenario.duration_s == FLAGS_duration_s) &&
                    (FLAGS_seed == 0 || scenario.seed == static_cast<std::uint64_t>(FLAGS_seed));
  if (!same) throw UsageError("--duration_s or --seed says one thing, and --set another");
  return scenario;
}

std::optional<trajlo::simulation::BagFormat> BagFormatFromFlags(const Scenario& scenario) {
  if (FLAGS_format == "pcd" && FLAGS_bag_layout.empty() && FLAGS_bag_compression == "none") {
    return {};
  }
  if (FLAGS_format == "pcd") {
    throw UsageError("--bag_layout and --bag_compression need --format=bag");
  }
  if (FLAGS_format != "bag") {
    throw UsageError("--format: must be pcd or bag, found '" + FLAGS_format + "'");
  }
  // Said before anything older is removed.
  if (scenario.motion_corrected) {
    throw UsageError("motion-corrected scans are written as KITTI has them, in no bag");
  }
  if (scenario.start_time_ns < 0) {
    throw UsageError("start_time_ns: ROS 1 has no stamps before 1970, found " +
                     std::to_string(scenario.start_time_ns) + "; --format=pcd has them");
  }
  trajlo::simulation::BagFormat format;
  format.layout = trajlo::ParseCloudLayout(FLAGS_bag_layout);
  if (!format.layout && !FLAGS_bag_layout.empty()) {
    throw UsageError("--bag_layout: must be ouster, velodyne or livox, found '" + FLAGS_bag_layout +
                     "'" + trajlo::DidYouMean(FLAGS_bag_layout, {"ouster", "velodyne", "livox"}));
  }
  const auto compression = trajlo::ros1::FindCompression(FLAGS_bag_compression);
  if (!compression) {
    throw UsageError("--bag_compression: must be none, lz4 or bz2, found '" +
                     FLAGS_bag_compression + "'");
  }
  format.compression = *compression;
  return format;
}

void List() {
  for (const std::string& name : trajlo::simulation::ScenarioNames()) {
    std::printf("%-28s %s\n", name.c_str(),
                trajlo::simulation::MakeScenario(name).description.c_str());
  }
}

void ListParameters(Scenario scenario) {
  for (const auto& parameter : trajlo::simulation::Parameters(&scenario)) {
    std::printf("%s=%s\n", parameter.key.c_str(),
                trajlo::simulation::ParameterText(parameter).c_str());
  }
}

/// A recording without a scan is none.
void RequireScans(const trajlo::simulation::Simulator& simulator) {
  for (std::size_t id = 0; id < simulator.scenario().rig.size(); ++id) {
    if (simulator.ScanCount(static_cast<int>(id)) > 0) continue;
    std::ostringstream text;
    text << simulator.scenario().duration_s << " s are too short for a scan of lidar" << id
         << "; give a larger --duration_s";
    throw UsageError(text.str());
  }
}

ExitCode Simulate(const trajlo::CommandLine& line) try {
  const std::string name = ScenarioName(line);
  if (FLAGS_list) {
    List();
    return ExitCode::kOk;
  }
  const Scenario scenario = ScenarioFromFlags(name);
  if (FLAGS_list_parameters) {
    ListParameters(scenario);
    return ExitCode::kOk;
  }
  if (FLAGS_output.empty()) throw UsageError("--output is missing");
  const auto bag = BagFormatFromFlags(scenario);
  const trajlo::simulation::Simulator simulator(scenario);
  RequireScans(simulator);
  try {
    const bool is_whole = trajlo::WriteRecording(
        simulator, {FLAGS_output, FLAGS_overwrite, bag, FLAGS_threads}, trajlo::HandleInterrupts());
    if (!is_whole) return ExitCode::kInterrupted;
  } catch (const std::runtime_error& error) {
    std::fprintf(stderr, "trajlo_simulate: %s\n", error.what());
    return ExitCode::kOutputNotWritable;
  }
  return ExitCode::kOk;
} catch (const std::logic_error& error) {  // Parameters that make no scenario,
  throw UsageError(error.what());
} catch (const std::runtime_error& error) {  // or a file that they name.
  throw UsageError(error.what());
}

std::vector<std::string> Values(const std::string& flag) {
  if (flag.empty() || flag == "scenario") return trajlo::simulation::ScenarioNames();
  if (flag == "format") return {"pcd", "bag"};
  if (flag == "bag_layout") return {"ouster", "velodyne", "livox"};
  if (flag == "bag_compression") return {"none", "lz4", "bz2"};
  if (flag != "set") return {};
  std::vector<std::string> settings;
  Scenario scenario = trajlo::simulation::MakeScenario("hall_os1_16");
  for (const auto& parameter : trajlo::simulation::Parameters(&scenario)) {
    const std::vector<std::string> choices = trajlo::simulation::ChoicesOf(parameter);
    if (choices.empty()) settings.push_back(parameter.key + "=");
    for (const std::string& choice : choices) settings.push_back(parameter.key + "=" + choice);
  }
  return settings;
}

}  // namespace

int main(int argc, char** argv) {
  return trajlo::RunCommand({"trajlo_simulate", kHelp, Simulate, Values}, argc, argv);
}
