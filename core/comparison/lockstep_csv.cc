// SPDX-License-Identifier: MIT
#include "core/comparison/lockstep_csv.h"

#include "core/report/csv_row.h"

namespace trajlo {

LockstepCsvWriter::LockstepCsvWriter(const std::filesystem::path& folder,
                                     const std::vector<SolverVariant>& variants)
    : variants_(variants),
      windows_(folder / "lockstep.csv", IfExists::kReplace),
      iterations_(folder / "iterations.csv", IfExists::kReplace) {
  iterations_.Write("window,variant,step,cost\n");
}

void LockstepCsvWriter::Append(const LockstepRecord& r) {
  const std::string& name = variants_[r.variant].name;
  CsvRow row;
  row.Add("window", r.window);
  row.Add("variant", name);
  row.Add("points", r.points);
  row.Add("finite", r.summary.finite ? 1 : 0);
  row.Add("steps", r.summary.iterations);
  row.Add("rejected_steps", r.summary.rejected_steps);
  row.Add("cost_before", r.cost_before.Total());
  row.Add("cost_before_registration", r.cost_before.registration);
  row.Add("cost_before_motion", r.cost_before.motion);
  row.Add("cost_before_prior", r.cost_before.prior);
  row.Add("cost_after", r.cost_after.Total());
  row.Add("cost_after_registration", r.cost_after.registration);
  row.Add("cost_after_motion", r.cost_after.motion);
  row.Add("cost_after_prior", r.cost_after.prior);
  row.Add("from_first_m", r.from_first.translation_m);
  row.Add("from_first_rad", r.from_first.rotation_rad);
  row.Add("evaluate_ms", 1e3 * r.summary.evaluate_s);
  row.Add("linear_solve_ms", 1e3 * r.summary.linear_solve_s);
  row.Add("total_ms", 1e3 * r.total_s);
  if (is_first_) windows_.Write(row.Names());
  is_first_ = false;
  windows_.Write(row.Values());
  for (std::size_t i = 0; i < r.summary.costs.size(); ++i) {
    CsvRow step;
    step.Add("window", r.window);
    step.Add("variant", name);
    step.Add("step", i);
    step.Add("cost", r.summary.costs[i]);
    iterations_.Write(step.Values());
  }
}

void LockstepCsvWriter::Close() {
  windows_.Close();
  iterations_.Close();
}

}  // namespace trajlo
