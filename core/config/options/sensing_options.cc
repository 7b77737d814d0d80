// SPDX-License-Identifier: MIT
// From points to segments.
#include "core/config/options/bind_options.h"
#include "core/config/options/option_binder.h"

namespace trajlo {

void BindSensing(SegmenterOptions* segmenter, OptionBinder* b) {
  b->Add("sensor.T_body_lidar", segmenter->T_body_lidar,
         "Pose of each LiDAR in the body frame; one LiDAR alone may go without, and is the body "
         "then.");
  b->Add("sensor.min_range_m", segmenter->min_range_m, Range<double>{0.0, 1e3},
         "Nearer points are dropped.");
  b->Add("sensor.max_range_m", segmenter->max_range_m, Range<double>{0.1, 1e4},
         "Farther points are dropped.");
  b->Add("sensor.vertical_correction_deg", segmenter->vertical_correction_deg,
         Range<double>{-5.0, 5.0},
         "Turns every ray up by this angle: the calibration error of KITTI's HDL-64E is 0.205.");
  b->Add("segmenter.first_interval_s", segmenter->first_interval_s, Range<double>{1e-3, 10.0},
         "Length of the first segment, which fills the map (paper: 0.3 s).");
  b->Add("segmenter.interval_s", segmenter->interval_s, Range<double>{1e-3, 10.0},
         "Length of all other segments, the paper's Delta t.");
  b->Add("segmenter.map_voxel_m", segmenter->map_voxel_m, Range<double>{1e-3, 10.0},
         "At most one point per cell of this size and segment enters the map.");
  b->Add("segmenter.registration_voxel_m", segmenter->registration_voxel_m,
         Range<double>{1e-3, 20.0}, "At most one of those per cell of this size is registered.");
  b->Add("segmenter.max_registration_points", segmenter->max_registration_points,
         Range<int>{0, 1000000},
         "At most this many are registered of a segment, taken evenly over its points; 0 takes "
         "all.");
  b->Add("segmenter.max_gap_s", segmenter->max_gap_s, Range<double>{1e-3, 1e3},
         "A longer pause becomes one gap segment; shorter ones become empty segments.");
  b->Add("segmenter.max_lag_s", segmenter->max_lag_s, Range<double>{0.0, 1e3},
         "A LiDAR that lags behind the others by more is not waited for.");
}

void BindAdaptiveInterval(AdaptiveIntervalOptions* interval, OptionBinder* b) {
  b->Add("adaptive_interval.enabled", interval->enabled,
         "Shortens segments while the motion asks for it; false keeps segmenter.interval_s.");
  b->Add(
      "adaptive_interval.divisions", interval->divisions, Range<int>{1, 20},
      "The shortest segment is segmenter.interval_s over this; all lengths are multiples of it.");
  b->Add("adaptive_interval.max_deviation_m", interval->max_deviation_m, Range<double>{1e-6, 10.0},
         "The trajectory within a segment may bend away from constant velocity by this ...");
  b->Add("adaptive_interval.lever_arm_m", interval->lever_arm_m, Range<double>{0.0, 1e3},
         "... at a point this far away, which angular acceleration moves.");
  b->Add("adaptive_interval.baseline_in_intervals", interval->baseline_in_intervals,
         Range<double>{0.1, 100.0},
         "Time between the velocities whose difference is the acceleration, in longest segments: "
         "over less, the noise of the poses looks like acceleration.");
  b->Add("adaptive_interval.memory_s", interval->memory_s, Range<double>{1e-3, 1e3},
         "Time over which motion is remembered.");
  b->Add("adaptive_interval.reserve", interval->reserve, Range<double>{1.0, 100.0},
         "Segments grow again only if the bound would hold with this factor to spare.");
}

}  // namespace trajlo
