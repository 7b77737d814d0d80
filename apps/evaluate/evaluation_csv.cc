// SPDX-License-Identifier: MIT
#include "apps/evaluate/evaluation_csv.h"

#include <cmath>

#include "apps/evaluate/flag_values.h"
#include "apps/evaluate/metric_columns.h"
#include "core/io/format_text.h"
#include "core/io/stamp_text.h"

namespace trajlo {
namespace {

/// Quoted only where the text needs it.
std::string Quoted(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c == '\n' || c == '\r' ? ' ' : c;
  }
  return quoted + "\"";
}

std::string Number(double value) {
  return std::isfinite(value) ? FormatText("%.12g", value) : "inf";
}

}  // namespace

std::string EvaluationCsv(const EvaluateRequest& request, const EvaluationReport& report) {
  const std::vector<MetricColumn> columns = MetricColumns(request.options.relative);
  std::string csv =
      "name,file,diverged,divergence_reason,association,alignment,scale,time_offset_s,pairs,"
      "completeness,paired_share,covered_share,path_length_m,duration_s,incomplete,"
      "rotation_sigma_deg,rotation_determined";
  for (const MetricColumn& column : columns) csv += "," + column.key;
  csv += "\n";
  for (const EstimateReport& estimate : report.estimates) {
    csv += Quoted(estimate.name) + "," + Quoted(estimate.trajectory.file) + "," +
           (estimate.Diverged() ? "true" : "false") + "," + Quoted(estimate.DivergenceReason()) +
           "," + AssociationName(request.options.association.rule) + "," +
           AlignmentName(request.options.alignment.kind);
    if (estimate.evaluation) {
      const Evaluation& e = *estimate.evaluation;
      for (const double value :
           {e.alignment.scale, e.time_offset_s, static_cast<double>(e.pairs.size()), e.completeness,
            e.paired_share, e.covered_share, e.path_length_m, e.duration_s}) {
        csv += "," + Number(value);
      }
      csv += std::string(",") + (e.incomplete ? "true" : "false") + ",";
      if (const auto sigma_deg = RotationSigmaDeg(e.alignment)) csv += Number(*sigma_deg);
      csv += std::string(",") + (e.rotation_determined ? "true" : "false");
    } else {
      csv += ",,,0,,,,,,,,";
    }
    for (const MetricColumn& column : columns) {
      const auto value =
          estimate.evaluation ? column.value(*estimate.evaluation) : std::optional<double>();
      csv += "," + (value ? Number(*value) : std::string());
    }
    csv += "\n";
  }
  return csv;
}

std::string ErrorsCsv(const Evaluation& evaluation, bool has_stamps) {
  std::string csv =
      "t_s,x_m,y_m,z_m,qx,qy,qz,qw,x_true_m,y_true_m,z_true_m,translation_error_m,"
      "rotation_error_deg\n";
  for (std::size_t i = 0; i < evaluation.pairs.size(); ++i) {
    const PosePair& pair = evaluation.pairs[i];
    const Eigen::Vector3d p = pair.estimate.translation();
    const Eigen::Quaterniond q = Eigen::Quaterniond(pair.estimate.linear()).normalized();
    const Eigen::Vector3d truth = pair.truth.translation();
    csv += has_stamps ? FormatSeconds(pair.t_ns) : std::to_string(pair.t_ns);
    // Micrometres: coordinates may be those of a map projection, with seven digits in front.
    csv += FormatText(",%.6f,%.6f,%.6f,%.9f,%.9f,%.9f,%.9f,%.6f,%.6f,%.6f,%.9g,", p.x(), p.y(),
                      p.z(), q.x(), q.y(), q.z(), q.w(), truth.x(), truth.y(), truth.z(),
                      evaluation.errors.translation_m[i]);
    if (evaluation.has_orientation) csv += Number(evaluation.errors.rotation_deg[i]);
    csv += "\n";
  }
  return csv;
}

}  // namespace trajlo
