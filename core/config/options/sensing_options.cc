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

}  // namespace trajlo
