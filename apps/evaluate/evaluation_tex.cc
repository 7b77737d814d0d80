// SPDX-License-Identifier: MIT
#include "apps/evaluate/evaluation_tex.h"

#include "apps/evaluate/metric_columns.h"

namespace trajlo {
namespace {

std::string Escaped(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '\\') {
      escaped += "\\textbackslash{}";
    } else if (c == '~' || c == '^') {
      escaped += std::string("\\") + c + "{}";
    } else {
      if (std::string("&%$#_{}").find(c) != std::string::npos) escaped += '\\';
      escaped += c;
    }
  }
  return escaped;
}

}  // namespace

std::string EvaluationTex(const EvaluateRequest& request, const EvaluationReport& report) {
  const std::vector<MetricColumn> columns = MainColumns(report, request.options.relative);
  std::string tex = "% estimate";
  for (const MetricColumn& column : columns) tex += " & " + column.title;
  tex += "\n";
  for (const EstimateReport& estimate : report.estimates) {
    tex += Escaped(estimate.name);
    for (const MetricColumn& column : columns) {
      tex += " & ";
      if (estimate.Diverged()) {
        tex += "$\\times$";
        continue;
      }
      const std::string value = FormatValue(column.value(*estimate.evaluation), column.decimals);
      const bool in_doubt = column.IsInDoubt(*estimate.evaluation);
      const bool best = !value.empty() && !in_doubt && value == BestValue(report, column);
      tex += value.empty() || in_doubt ? "--" : best ? "\\textbf{" + value + "}" : value;
    }
    tex += " \\\\\n";
  }
  return tex;
}

}  // namespace trajlo
