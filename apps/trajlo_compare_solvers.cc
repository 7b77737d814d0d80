// SPDX-License-Identifier: MIT
// Compares solvers on the same windows, and on the same recording. See --help.
#include <gflags/gflags.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/command.h"
#include "apps/compare/compare_job.h"
#include "apps/config_names.h"
#include "apps/inputs.h"
#include "apps/interrupt.h"
#include "apps/load_config.h"
#include "apps/require_extrinsics.h"
#include "apps/split_at_commas.h"
#include "apps/usage_error.h"
#include "core/options/did_you_mean.h"

DEFINE_string(input, "", "the recording, as for trajlo_run");
DEFINE_string(output, "", "the folder to write");
DEFINE_string(config, "", "names or YAML files, separated by commas; later ones win");
DEFINE_string(set, "", "options for all variants: key=value, separated by commas");
DEFINE_string(variants, "",
              "YAML file with the variants; empty takes config/comparisons/solvers.yaml");
DEFINE_string(only, "",
              "names of the variants to take, separated by commas; the first is the reference");
DEFINE_string(mode, "both", "lockstep, free or both");
DEFINE_int32(every, 5, "lockstep: compare every Nth window");
DEFINE_string(truth, "", "ground truth of the trajectory, for errors of the free runs");
DEFINE_int32(threads, 1, "for all variants; 1 makes their times comparable");
DEFINE_bool(overwrite, false, "replace an earlier result in the output folder");
DEFINE_bool(report, true, "draw figures and a page into the output folder");
DEFINE_bool(quiet, false, "print warnings and errors only");

namespace {

using trajlo::ExitCode;
using trajlo::UsageError;

constexpr char kHelp[] = R"(Compares solvers on the same windows, and on the same recording.

  trajlo_compare_solvers recording -o comparison
      lockstep: in every fifth window, all variants start from the same poses, associations and
      prior; free: each runs the whole recording by itself. Writes
        comparison/comparison.json       everything, with settings and versions
        comparison/lockstep.csv          a row per window and variant: costs by factor, steps,
                                         distance between the solutions, times by stage
        comparison/iterations.csv        the cost after every step
        comparison/lockstep_summary.csv, free_summary.csv   a row per variant
        comparison/free/VARIANT/         trajectory.tum and windows.csv of each run
        comparison/report.html           the figures on one page (also as SVG, PDF and PNG)
  trajlo_compare_solvers recording -o comparison --truth=truth.tum
      with the errors of the free runs
  trajlo_compare_solvers recording -o two --only=gauss_newton,ceres --every=1
      two of the variants, in every window; the first is the reference
  trajlo_compare_solvers recording -o mine --variants=my_variants.yaml --mode=free
      my_variants.yaml:
        variants:
          - {name: paper, set: "expert.map.levels=1"}
          - {name: wide, set: "expert.registration.kernel_in_spreads=0,expert.registration.kernel_m=1.0"}

Flags:
  -o, --output=FOLDER       where the comparison goes
  --input=, --config=, --set=   as for trajlo_run, for all variants (trajlo_run --show_config lists
                            all options)
  --threads=N               for all variants (1, which makes their times comparable)
  --mode=lockstep|free|both
  --variants=FILE           YAML with the variants (config/comparisons/solvers.yaml)
  --only=A,B                only these variants; the first is the reference
  --every=N                 lockstep: compare every Nth window (5)
  --truth=FILE              ground truth, for the errors of the free runs
  --noreport                draw no figures
  --overwrite               replace an earlier result
  --quiet                   print warnings and errors only
  -h, --help, --version

Exit codes: 0 done, 1 wrong usage or configuration, 2 input unreadable, 3 part of the input was
damaged or in doubt, or nothing could be compared, 4 a run got lost, 5 output not writable, 6 out of
memory or a defect of the program, 130 interrupted; what was compared so far is written.
)";

/// Those that `only` names, in its order; all if it is empty.
std::vector<trajlo::SolverVariant> Choose(const std::vector<trajlo::SolverVariant>& variants,
                                          const std::vector<std::string>& only) {
  if (only.empty()) return variants;
  std::vector<trajlo::SolverVariant> chosen;
  for (const std::string& name : only) {
    std::vector<std::string> names;
    if (std::count(only.begin(), only.end(), name) > 1) {
      throw UsageError("--only: '" + name + "' appears twice; name each variant once");
    }
    for (const auto& variant : variants) {
      if (variant.name == name) chosen.push_back(variant);
      names.push_back(variant.name);
    }
    if (!chosen.empty() && chosen.back().name == name) continue;
    std::string mend = trajlo::DidYouMean(name, names);
    if (mend.empty()) {
      mend = "; there are:";
      for (const std::string& other : names) mend += " " + other;
    }
    throw UsageError("--only: no variant '" + name + "'" + mend);
  }
  return chosen;
}

trajlo::CompareRequest RequestFromFlags(const trajlo::CommandLine& line) {
  trajlo::CompareRequest request;
  request.command_line = line.words;
  request.inputs = trajlo::InputsOf(line, FLAGS_input);
  if (FLAGS_output.empty()) throw UsageError("--output is missing");
  request.config = trajlo::LoadConfig(FLAGS_config, FLAGS_set, {{"threads", "threads", "1"}});
  trajlo::CheckConfig(request.config);
  trajlo::RequireExtrinsics(request.inputs, request.config);
  trajlo::RequireOptionsOfEachLidar(request.inputs, request.config.input);
  std::filesystem::path variants = FLAGS_variants;
  if (variants.empty()) variants = trajlo::ConfigFolder("--variants") / "comparisons/solvers.yaml";
  request.variants =
      Choose(trajlo::LoadVariants(variants, request.config), trajlo::SplitAtCommas(FLAGS_only));
  if (FLAGS_mode != "both" && FLAGS_mode != "lockstep" && FLAGS_mode != "free") {
    throw UsageError("--mode: must be lockstep, free or both, found '" + FLAGS_mode + "'" +
                     trajlo::DidYouMean(FLAGS_mode, {"lockstep", "free", "both"}));
  }
  if (FLAGS_every < 1) throw UsageError("--every: must be at least 1");
  request.lockstep = FLAGS_mode != "free";
  request.free = FLAGS_mode != "lockstep";
  request.lockstep_options.every = FLAGS_every;
  request.output = FLAGS_output;
  request.truth = FLAGS_truth;
  request.overwrite = FLAGS_overwrite;
  request.quiet = FLAGS_quiet;
  request.draw = FLAGS_report;
  return request;
}

ExitCode Compare(const trajlo::CommandLine& line) {
  return trajlo::RunComparison(RequestFromFlags(line), trajlo::HandleInterrupts());
}

std::vector<std::string> Values(const std::string& flag) {
  if (flag == "mode") return {"both", "lockstep", "free"};
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  return trajlo::RunCommand({"trajlo_compare_solvers", kHelp, Compare, Values}, argc, argv);
}
