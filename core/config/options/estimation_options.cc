// SPDX-License-Identifier: MIT
// The run as a whole.
#include "core/config/options/bind_options.h"
#include "core/config/options/option_binder.h"

namespace trajlo {
namespace {

const Names<Deskewing> kDeskewings = {{"estimated", Deskewing::kEstimated},
                                      {"predicted", Deskewing::kPredicted}};

}  // namespace

void BindEstimation(OdometryOptions* odometry, OptionBinder* b) {
  b->Add("window.segments", odometry->window.segments, Range<int>{1, 100},
         "Segments that are estimated together, the paper's K.");
  b->Add("window.deskewing", odometry->window.deskewing, kDeskewings,
         "What moves the points of a segment to one time: the estimated trajectory, in every "
         "iteration anew, or once the predicted motion (discrete poses and constant velocity, as "
         "in KISS-ICP; for comparison).");
  b->Add("initialization.estimate_motion", odometry->initialization.estimate_motion,
         "Estimates the motion during the first interval by registering its second half to its "
         "first one; false assumes a stationary start, as the paper does.");
  b->Add("lost.min_inlier_share", odometry->lost.min_inlier_share, Range<double>{0.0, 1.0},
         "The estimator is lost when fewer than this share of the points find a plane ...");
  b->Add("lost.max_duration_s", odometry->lost.max_duration_s, Range<double>{0.0, 1e6},
         "... for longer than this ...");
  b->Add("lost.convergence_span_s", odometry->lost.convergence_span_s, Range<double>{0.0, 1e6},
         "... or when of all windows of this time ...");
  b->Add("lost.max_unconverged_share", odometry->lost.max_unconverged_share,
         Range<double>{0.0, 1.0},
         "... more than this share did not converge, or half of this while predictions failed.");
  b->Add("lost.max_correction_m", odometry->lost.max_correction_m, Range<double>{1e-3, 1e3},
         "A solve that moves the newest pose farther than this from its prediction ...");
  b->Add("lost.max_correction_rad", odometry->lost.max_correction_rad, Range<double>{1e-3, 10.0},
         "... or turns it by more than this is not believed.");
  b->Add("lost.degenerate_eigenvalue", odometry->lost.degenerate_eigenvalue,
         Range<double>{0.0, 1.0},
         "Below this information per point a direction counts as degenerate (a well-spread scene "
         "has 0.05 to 0.2).");
  b->Add("covariance_scale", odometry->covariance_scale, Range<double>{1e-6, 1e9},
         "Multiplies the covariances that are written: the window takes the map for exact and the "
         "errors of its points for independent, so 1 is optimistic.");
  b->Add("threads", odometry->threads, Range<int>{0, 1024},
         "0 takes all cores; no result depends on it. So many also decompress bz2 chunks of a "
         "ROS 1 bag ahead; with 1 a single thread reads beside the estimator.");
}

}  // namespace trajlo
