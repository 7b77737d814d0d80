// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/evaluate/evaluation_json.h"
#include "apps/evaluate/flag_values.h"
#include "apps/python/module/arrays.h"
#include "apps/python/module/bindings.h"
#include "apps/python/module/errors.h"
#include "apps/python/module/flagged_trajectory.h"
#include "apps/usage_error.h"
#include "core/evaluation/evaluation_error.h"
#include "core/io/errors.h"
#include "core/io/format_text.h"
#include "core/io/scan_stamps.h"

namespace trajlo::python {
namespace {

/// A trajectory to compare, from a file or from memory.
struct Poses {
  std::string name;
  TimedPoses timed;
  std::vector<std::string> warnings;
};

TrajectoryFormat FormatFrom(const std::string& name) {
  const auto format = ParseTrajectoryFormat(name);
  if (!format) throw UsageError("format: must be auto, tum, kitti or euroc, found '" + name + "'");
  return *format;
}

Poses ReadFile(const py::object& path, const std::string& format, const py::object& times,
               const std::string& repeated_stamps, const std::string& association) {
  Poses poses;
  poses.name = PathText(path);
  TrajectoryFile file = ReadTrajectory(poses.name, FormatFrom(format), &poses.warnings);
  if (file.t_ns.empty() && !times.is_none()) {
    file.t_ns = ReadStampsFile(PathText(times));
    if (file.t_ns.size() != file.T_world_body.size()) {
      throw InputError(PathText(times),
                       "has " + CountOf(file.t_ns.size(), "stamp") + ", and " + poses.name + " " +
                           CountOf(file.T_world_body.size(), "pose"),
                       "There must be one stamp for each line.");
    }
  }
  const RepeatedStamps repeated =
      ParseRepeatedStamps(repeated_stamps, ParseAssociation(association));
  poses.timed = OrderByTime(file, poses.name, repeated, &poses.warnings);
  return poses;
}

Poses FromTrajectory(const FlaggedTrajectory& trajectory, const std::string& name) {
  Poses poses;
  poses.name = name;
  for (const ControlPose& pose : trajectory.poses()) {
    poses.timed.t_ns.push_back(pose.t_ns);
    poses.timed.T_world_body.emplace_back(Eigen::Translation3d(pose.T_world_body.t) *
                                          pose.T_world_body.q);
  }
  return poses;
}

/// `flags`: one for each pose, or None.
FlaggedTrajectory ToTrajectory(const Poses& poses, const py::object& flags) {
  if (!poses.timed.HasStamps()) {
    throw InputError(poses.name, "the poses have no stamps", "Give a file of them: times=...");
  }
  std::vector<std::int64_t> known(poses.timed.size());
  if (!flags.is_none()) known = ReadIntegers(flags, "flags");
  if (known.size() != poses.timed.size()) throw DataError("flags: must be one for each pose");
  Trajectory trajectory;
  for (std::size_t i = 0; i < poses.timed.size(); ++i) {
    const Eigen::Affine3d& T = poses.timed.T_world_body[i];
    trajectory.Append({poses.timed.t_ns[i],
                       {Eigen::Quaterniond(T.linear()).normalized(), T.translation()},
                       static_cast<unsigned>(known[i])});
  }
  if (flags.is_none()) return FlaggedTrajectory(trajectory);
  return {trajectory, PoseFlags(trajectory.poses(), std::nullopt)};
}

/// The keyword arguments of evaluate(), which are all there.
class Arguments {
 public:
  explicit Arguments(py::dict values) : values_(std::move(values)) {}

  py::object Get(const char* name) const { return values_[name]; }
  std::string Text(const char* name) const { return Cast<std::string>(name, "text"); }
  bool Flag(const char* name) const {
    if (!py::isinstance<py::bool_>(Get(name))) Fail(name, "True or False");
    return py::cast<bool>(Get(name));
  }
  double Number(const char* name, double low, double high) const {
    const double value = Cast<double>(name, "a number");
    if (value >= low && value <= high) return value;
    throw UsageError(FormatText("%s: must be between %g and %g", name, low, high));
  }

 private:
  template <typename T>
  T Cast(const char* name, const char* expected) const {
    try {
      return py::cast<T>(Get(name));
    } catch (const py::cast_error&) {
      Fail(name, expected);
    }
  }
  [[noreturn]] void Fail(const char* name, const char* expected) const {
    throw UsageError(std::string(name) + ": must be " + expected + ", found " +
                     std::string(py::repr(Get(name))));
  }

  py::dict values_;
};

/// The ranges are those of trajlo_evaluate.
EvaluationOptions OptionsFrom(const Arguments& arguments) {
  constexpr double kLong_s = 1e9;
  EvaluationOptions o;
  o.association.rule = ParseAssociation(arguments.Text("association"));
  o.association.max_gap_s = arguments.Number("max_gap_s", 0.0, kLong_s);
  o.association.max_time_difference_s = arguments.Number("max_time_difference_s", 0.0, kLong_s);
  RequireFineSeconds(arguments.Get("time_offset_s"), "time_offset_s");
  o.time_offset_s = arguments.Number("time_offset_s", -2.0 * kLong_s, 2.0 * kLong_s);
  o.estimate_time_offset = arguments.Flag("estimate_time_offset");
  o.time_offset_reach_s = arguments.Number("time_offset_reach_s", 0.001, 60.0);
  o.alignment.kind = ParseAlignment(arguments.Text("alignment"));
  ParseAlignFirst(arguments.Text("align_first"), &o.alignment);
  o.truth_orientation = ParseTruthOrientation(arguments.Text("truth_orientation"));
  if (const py::object T = arguments.Get("T_body_truth"); !T.is_none()) {
    const SE3 pose = ReadPose(T, "T_body_truth");
    o.T_body_truth = Eigen::Translation3d(pose.t) * pose.q;
  }
  o.relative = ParsePieces(arguments.Text("rpe"));
  for (RelativeErrorOptions& piece : o.relative) {
    piece.all_pairs = arguments.Flag("rpe_all_pairs");
    piece.along_truth = arguments.Flag("rpe_along_truth");
    piece.tolerance = arguments.Number("rpe_tolerance", 1e-9, HUGE_VAL);
  }
  o.divergence.ate_share_of_path = 0.01 * arguments.Number("diverged_percent", 0.0, 1e9);
  o.divergence.ate_m = arguments.Number("diverged_m", 0.0, 1e12);
  o.divergence.min_completeness = arguments.Number("min_completeness", 0.0, 1.0);
  return o;
}

py::array_t<double> Matrices(const Evaluation& evaluation, Eigen::Affine3d PosePair::*member) {
  py::array_t<double> array(
      {static_cast<py::ssize_t>(evaluation.pairs.size()), py::ssize_t{4}, py::ssize_t{4}});
  double* out = array.mutable_data();
  for (const PosePair& pair : evaluation.pairs) {
    Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> m(out);
    m = (pair.*member).matrix();
    out += 16;
  }
  return array;
}

py::dict Errors(const Evaluation& evaluation) {
  std::vector<std::int64_t> t_ns;
  for (const PosePair& pair : evaluation.pairs) t_ns.push_back(pair.t_ns);
  py::dict errors;
  errors["t_ns"] = CopyOf(t_ns);
  errors["T_world_body"] = Matrices(evaluation, &PosePair::estimate);
  errors["T_world_truth"] = Matrices(evaluation, &PosePair::truth);
  errors["translation_m"] = CopyOf(evaluation.errors.translation_m);
  errors["rotation_deg"] =
      CopyOf(evaluation.has_orientation ? evaluation.errors.rotation_deg : std::vector<double>());
  return errors;
}

TrajectorySummary Summary(const Poses& poses) {
  TrajectorySummary summary;
  summary.file = poses.name;
  summary.poses = poses.timed.size();
  summary.path_length_m = PathLength(poses.timed.T_world_body);
  summary.has_stamps = poses.timed.HasStamps();
  if (summary.has_stamps) {
    summary.begin_ns = poses.timed.t_ns.front();
    summary.end_ns = poses.timed.t_ns.back();
  }
  return summary;
}

/// (the text of evaluation.json, the errors as arrays)
py::tuple EvaluatePoses(const Poses& estimate, const Poses& truth, const py::dict& arguments) {
  EvaluateRequest request;
  request.options = OptionsFrom(Arguments(arguments));
  request.repeated_stamps = ParseRepeatedStamps(Arguments(arguments).Text("repeated_stamps"),
                                                request.options.association.rule);
  EvaluationReport report;
  report.warnings = estimate.warnings;
  report.warnings.insert(report.warnings.end(), truth.warnings.begin(), truth.warnings.end());
  std::string json;
  {
    const py::gil_scoped_release release;
    if (estimate.timed.size() == 0 || truth.timed.size() == 0) {
      throw EvaluationError("there are no poses to compare");
    }
    EstimateReport one;
    one.name = estimate.name;
    one.trajectory = Summary(estimate);
    one.evaluation = Evaluate(estimate.timed, truth.timed, request.options);
    report.truth = Summary(truth);
    report.truth_has_orientation = UsesOrientation(truth.timed, request.options.truth_orientation);
    report.warnings.insert(report.warnings.end(), one.evaluation->warnings.begin(),
                           one.evaluation->warnings.end());
    report.estimates.push_back(std::move(one));
    json = EvaluationJson(request, report);
  }
  return py::make_tuple(json, Errors(*report.estimates.front().evaluation));
}

}  // namespace

void BindEvaluation(py::module_* module) {
  py::class_<Poses>(*module, "Poses", "A trajectory to compare.")
      .def_static("from_file", &ReadFile, py::arg("path"), py::arg("format"), py::arg("times"),
                  py::arg("repeated_stamps"), py::arg("association"))
      .def_static("from_trajectory", &FromTrajectory, py::arg("trajectory"), py::arg("name"))
      .def("trajectory", &ToTrajectory, py::arg("flags") = py::none())
      .def_readonly("warnings", &Poses::warnings);
  module->def("evaluate", &EvaluatePoses, py::arg("estimate"), py::arg("truth"),
              py::arg("arguments"));
}

}  // namespace trajlo::python
