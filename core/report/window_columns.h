// SPDX-License-Identifier: MIT
#pragma once

#include "core/odometry/health/window_statistics.h"
#include "core/report/window_csv.h"

namespace trajlo {

/// The columns of windows.csv, of one window. `row` has Add(name, value) for text and numbers, and
/// AddTime(name, t_ns) for times, whose columns are in seconds.
template <typename Row>
void AddWindowColumns(const WindowStatistics& w, Row* row) {
  row->Add("index", w.index);
  row->AddTime("begin_s", w.begin_ns);
  row->AddTime("end_s", w.end_ns);
  row->Add("segments", w.segments);
  row->Add("points", w.points);
  row->Add("inliers", w.inliers);
  row->Add("inlier_share", w.InlierShare());
  row->Add("agreement", w.agreement);
  row->Add("searched", w.searched);
  row->Add("rounds", w.rounds);
  row->Add("iterations", w.iterations);
  row->Add("rejected_steps", w.rejected_steps);
  row->Add("cost_registration", w.cost.registration);
  row->Add("cost_motion", w.cost.motion);
  row->Add("cost_prior", w.cost.prior);
  row->Add("translation_density_m2_s3", w.translation_density_m2_s3);
  row->Add("rotation_density_rad2_s3", w.rotation_density_rad2_s3);
  row->Add("velocity_persistence", w.velocity_persistence);
  row->Add("noise_factor", w.noise_factor);
  row->Add("correction_m", w.correction.translation_m);
  row->Add("correction_rad", w.correction.rotation_rad);
  row->Add("smallest_eigenvalue", w.smallest_eigenvalue);
  row->Add("weak_rho_x", w.weak_direction[0]);
  row->Add("weak_rho_y", w.weak_direction[1]);
  row->Add("weak_rho_z", w.weak_direction[2]);
  row->Add("weak_theta_x", w.weak_direction[3]);
  row->Add("weak_theta_y", w.weak_direction[4]);
  row->Add("weak_theta_z", w.weak_direction[5]);
  row->Add("weak_axis", AxisName(w.weak_direction));
  row->Add("last_step_m", w.last_step.translation_m);
  row->Add("last_step_rad", w.last_step.rotation_rad);
  row->Add("segment_ms", w.milliseconds_segment);
  row->Add("associate_ms", w.milliseconds_associate);
  row->Add("solve_ms", w.milliseconds_solve);
  row->Add("marginalize_ms", w.milliseconds_marginalize);
  row->Add("map_ms", w.milliseconds_map);
  row->Add("flags", w.flags);
  row->Add("flag_names", FlagNames(w.flags));
}

}  // namespace trajlo
