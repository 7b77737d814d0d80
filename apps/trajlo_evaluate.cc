// SPDX-License-Identifier: MIT
// Errors of estimated trajectories against ground truth. See --help.
#include <gflags/gflags.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "apps/command.h"
#include "apps/evaluate/evaluate_job.h"
#include "apps/evaluate/flag_values.h"
#include "apps/evaluate/labels.h"
#include "apps/split_at_commas.h"
#include "apps/usage_error.h"
#include "core/io/format_text.h"

DEFINE_string(truth, "", "the ground truth; all other arguments are estimates then");
DEFINE_string(names, "", "names of the estimates, separated by commas");
DEFINE_string(output, "", "the folder to write");
DEFINE_bool(overwrite, false, "replace an earlier result in the output folder");
DEFINE_bool(report, true, "draw figures and a page into the output folder");
DEFINE_bool(quiet, false, "print warnings and errors only");
DEFINE_string(format, "auto", "of the estimates: auto, tum, kitti or euroc");
DEFINE_string(truth_format, "auto", "of the ground truth: auto, tum, kitti or euroc");
DEFINE_string(times, "", "stamps for the lines of KITTI files");
DEFINE_string(repeated_stamps, "auto", "auto, first, last or all");
DEFINE_string(association, "interpolate",
              "interpolate, interpolate_estimate, nearest or one_to_one");
DEFINE_double(max_gap_s, 0.0, "do not interpolate across longer gaps; 0 for automatic");
DEFINE_double(max_time_difference_s, 0.01, "of pairs that are not interpolated");
DEFINE_double(time_offset_s, 0.0, "added to the stamps of the estimates");
DEFINE_bool(estimate_time_offset, false, "find the offset with the smallest absolute error");
DEFINE_double(time_offset_reach_s, 0.5, "how far from --time_offset_s it is looked for");
DEFINE_string(alignment, "se3", "se3, sim3, scale, origin or none");
DEFINE_string(align_first, "", "align by the first pairs (100) or seconds (10s) only");
DEFINE_string(lever_arm, "", "x,y,z of the point that the truth describes, in the body frame, m");
DEFINE_string(T_body_truth, "", "the frame that the truth describes, in the body frame");
DEFINE_string(truth_orientation, "auto", "auto, use or ignore");
DEFINE_string(rpe, "1m,10m,1s", "lengths of relative errors");
DEFINE_bool(rpe_all_pairs, false, "relative errors from every pose instead of pieces in a row");
DEFINE_bool(rpe_along_truth, false, "measure lengths along the truth");
DEFINE_double(rpe_tolerance, 0.1, "how far lengths may be off, as a share");
DEFINE_double(diverged_percent, 10.0, "of the path: a larger absolute error is a failed run");
DEFINE_double(diverged_m, 0.0, "a larger absolute error is a failed run; 0 for no such rule");
DEFINE_double(min_completeness, 0.5, "a smaller share of the truth covered is a failed run");

namespace {

using trajlo::EvaluateRequest;
using trajlo::ExitCode;
using trajlo::UsageError;

constexpr char kHelp[] = R"(Errors of estimated trajectories against ground truth.

  trajlo_evaluate result truth.tum
      the trajectory in a folder that trajlo_run wrote; a file by its name
  trajlo_evaluate estimate.tum truth.tum
      absolute error (ATE), relative errors (RPE) and KITTI's errors
  trajlo_evaluate a/trajectory.tum b/trajectory.tum --truth=truth.tum --names=ours,theirs
      several estimates in one table
  trajlo_evaluate estimate.tum truth.tum -o evaluation
      writes evaluation/evaluation.json   every number, settings, warnings
             evaluation/evaluation.csv    a row for each estimate
             evaluation/evaluation.tex    rows for a LaTeX table
             evaluation/errors_NAME.csv   aligned poses and errors
             evaluation/report.html       with figures (--noreport: none)
  trajlo_evaluate estimate.tum prism.tum --lever_arm=-0.293656,-0.012288,-0.273095
      the truth is the path of a prism at that place in the body frame (NTU VIRAL)
  trajlo_evaluate estimate.tum truth.txt --times=times.txt --T_body_truth=x,y,z,qx,qy,qz,qw
      the truth is in KITTI's format, of another frame on the body (or 12 numbers, row by row)
  trajlo_evaluate estimate.tum truth.csv --association=nearest
      pairs exactly as evo forms them

Files
  --format=FORMAT, --truth_format=FORMAT   auto (by the content), tum, kitti or euroc
  --truth=FILE                the ground truth; all arguments are estimates then
  --names=A,B                 names of the estimates, for tables and files
  --times=FILE                stamps for the lines of KITTI files
  --repeated_stamps=auto|first|last|all   which of several poses with one stamp count; auto: all
                              with --association=nearest (as in evo), last with one_to_one (as in
                              the TUM RGB-D benchmark), otherwise first
  -o, --output=FOLDER         write tables, errors and a page there
  --overwrite, --noreport     replace an earlier result; draw no figures

Pairs
  --association=interpolate   the truth at every pose of the estimate (the default),
               interpolate_estimate   the estimate at every pose of the truth (for sparse truth),
               nearest        no interpolation, evo's rule,
               one_to_one     no interpolation, closest pairs first and no pose twice: the TUM
                              RGB-D benchmark's rule (--max_time_difference_s=0.02 by default there)
  --max_gap_s=S               do not interpolate across longer gaps; 0: 2.5 typical intervals, at
                              least 0.05 s
  --max_time_difference_s=S   of nearest poses and one-to-one pairs (0.01)
  --time_offset_s=S           added to the stamps of the estimate (0)
  --estimate_time_offset      find the offset that makes the absolute position error smallest, up
                              to --time_offset_reach_s=S (0.5) away
  --truth_orientation=auto|use|ignore   auto ignores rotations that are all the identity

The frame of the truth
  --lever_arm=x,y,z           the point that the truth describes, in the body frame, m
  --T_body_truth=x,y,z,qx,qy,qz,qw   the frame that the truth describes, in the body frame

Alignment
  --alignment=se3|sim3|scale|origin|none   Umeyama without or with scale, its scale alone, the
                              first pose, nothing
  --align_first=100 or 10s    by the first pairs or seconds only

Relative errors
  --rpe=1m,10m,1s             lengths: m, s, f (frames), d (degrees). Metres, frames and degrees
                              as evo, seconds as the TUM RGB-D benchmark
  --rpe_all_pairs             from every pose instead of pieces in a row
  --rpe_along_truth           metres and degrees along the truth instead of the aligned estimate
  --rpe_tolerance=0.1         how far lengths in s, and in m from every pose, may be off, relative to
                              the length (inf for seconds exactly as the TUM RGB-D benchmark)

An x marks runs that diverged or are incomplete. A run diverged if its absolute error is not finite,
or is above both --diverged_percent=P (10) percent of the path and 0.5 m, or is above --diverged_m=D
(0: no such rule). It is incomplete if it covers less than --min_completeness=SHARE (0.5) of the
poses of the truth. A pose is covered if it lies between two poses of the estimate that are at most
1 s apart. A ? marks absolute rotation errors that are mostly a turn which the alignment leaves
open, as positions on a line fix no rotation about it: use --alignment=origin, or relative errors.

More flags: --quiet (print warnings and errors only), -h, --help, --version

Exit codes: 0 ok (also if a run diverged), 1 wrong usage, 2 input unreadable or nothing to compare,
3 some of several estimates could not be compared, 5 output not writable, 6 out of memory or a
defect of the program.
)";

void CheckRange(const char* flag, double value, double low, double high) {
  if (value >= low && value <= high) return;
  throw UsageError(trajlo::FormatText("--%s: must be between %g and %g", flag, low, high));
}

trajlo::EvaluationOptions OptionsFromFlags() {
  constexpr double kLong_s = 1e9;
  trajlo::EvaluationOptions options;
  options.association.rule = trajlo::ParseAssociation(FLAGS_association);
  CheckRange("max_gap_s", FLAGS_max_gap_s, 0.0, kLong_s);
  options.association.max_gap_s = FLAGS_max_gap_s;
  CheckRange("max_time_difference_s", FLAGS_max_time_difference_s, 0.0, kLong_s);
  options.association.max_time_difference_s = FLAGS_max_time_difference_s;
  CheckRange("time_offset_s", FLAGS_time_offset_s, -2.0 * kLong_s, 2.0 * kLong_s);
  options.time_offset_s = FLAGS_time_offset_s;
  options.estimate_time_offset = FLAGS_estimate_time_offset;
  CheckRange("time_offset_reach_s", FLAGS_time_offset_reach_s, 0.001, 60.0);
  options.time_offset_reach_s = FLAGS_time_offset_reach_s;
  options.alignment.kind = trajlo::ParseAlignment(FLAGS_alignment);
  trajlo::ParseAlignFirst(FLAGS_align_first, &options.alignment);
  options.truth_orientation = trajlo::ParseTruthOrientation(FLAGS_truth_orientation);
  if (!FLAGS_lever_arm.empty() && !FLAGS_T_body_truth.empty()) {
    throw UsageError("--lever_arm and --T_body_truth exclude each other");
  }
  if (!FLAGS_lever_arm.empty()) options.T_body_truth = trajlo::ParseLeverArm(FLAGS_lever_arm);
  if (!FLAGS_T_body_truth.empty()) options.T_body_truth = trajlo::ParsePose(FLAGS_T_body_truth);
  if (!(FLAGS_rpe_tolerance > 0.0)) throw UsageError("--rpe_tolerance: must be positive");
  options.relative = trajlo::ParsePieces(FLAGS_rpe);
  for (trajlo::RelativeErrorOptions& piece : options.relative) {
    piece.all_pairs = FLAGS_rpe_all_pairs;
    piece.along_truth = FLAGS_rpe_along_truth;
    piece.tolerance = FLAGS_rpe_tolerance;
  }
  CheckRange("diverged_percent", FLAGS_diverged_percent, 0.0, 1e9);
  options.divergence.ate_share_of_path = 0.01 * FLAGS_diverged_percent;
  CheckRange("diverged_m", FLAGS_diverged_m, 0.0, 1e12);
  options.divergence.ate_m = FLAGS_diverged_m;
  CheckRange("min_completeness", FLAGS_min_completeness, 0.0, 1.0);
  options.divergence.min_completeness = FLAGS_min_completeness;
  return options;
}

trajlo::TrajectoryFormat FormatFromFlag(const char* flag, const std::string& name) {
  const auto format = trajlo::ParseTrajectoryFormat(name);
  if (!format) {
    throw UsageError(std::string("--") + flag + ": must be auto, tum, kitti or euroc, found '" +
                     name + "'");
  }
  return *format;
}

EvaluateRequest RequestFromFlags(std::vector<std::string> arguments) {
  EvaluateRequest request;
  if (FLAGS_truth.empty()) {
    if (arguments.size() != 2) {
      throw UsageError(
          "give an estimate and the ground truth, or any number of estimates and "
          "--truth=FILE");
    }
    request.truth = arguments.back();
    arguments.pop_back();
  } else {
    request.truth = FLAGS_truth;
  }
  if (arguments.empty()) throw UsageError("there is no estimate");
  for (const std::filesystem::path argument : arguments) {
    const bool ends_in_slash = !argument.has_filename() && argument.has_relative_path();
    request.estimates.push_back(ends_in_slash ? argument.parent_path() : argument);
  }
  request.names =
      FLAGS_names.empty() ? trajlo::Labels(request.estimates) : trajlo::SplitAtCommas(FLAGS_names);
  if (request.names.size() != request.estimates.size() ||
      std::set<std::string>(request.names.begin(), request.names.end()).size() !=
          request.names.size()) {
    throw UsageError("--names: must be " + std::to_string(request.estimates.size()) +
                     " different names, separated by commas");
  }
  request.estimate_format = FormatFromFlag("format", FLAGS_format);
  request.truth_format = FormatFromFlag("truth_format", FLAGS_truth_format);
  request.times = FLAGS_times;
  request.options = OptionsFromFlags();
  request.repeated_stamps =
      trajlo::ParseRepeatedStamps(FLAGS_repeated_stamps, request.options.association.rule);
  request.output = FLAGS_output;
  request.overwrite = FLAGS_overwrite;
  request.draw = FLAGS_report;
  request.quiet = FLAGS_quiet;
  return request;
}

ExitCode Evaluate(const trajlo::CommandLine& line) {
  EvaluateRequest request = RequestFromFlags(line.arguments);
  request.command_line = line.words;
  return trajlo::EvaluateJob(request);
}

std::vector<std::string> Values(const std::string& flag) {
  if (flag == "format" || flag == "truth_format") return {"auto", "tum", "kitti", "euroc"};
  if (flag == "repeated_stamps") return {"auto", "first", "last", "all"};
  if (flag == "association") {
    return {"interpolate", "interpolate_estimate", "nearest", "one_to_one"};
  }
  if (flag == "alignment") return {"se3", "sim3", "scale", "origin", "none"};
  if (flag == "truth_orientation") return {"auto", "use", "ignore"};
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  return trajlo::RunCommand({"trajlo_evaluate", kHelp, Evaluate, Values}, argc, argv);
}
