// SPDX-License-Identifier: MIT
// What counts how much.
#include "core/config/options/bind_options.h"
#include "core/config/options/option_binder.h"

namespace trajlo {
namespace {

const Names<KernelKind> kKernels = {{"none", KernelKind::kNone},
                                    {"huber", KernelKind::kHuber},
                                    {"cauchy", KernelKind::kCauchy},
                                    {"geman_mcclure", KernelKind::kGemanMcClure},
                                    {"tukey", KernelKind::kTukey}};

}  // namespace

void BindThreshold(AdaptiveThresholdOptions* threshold, OptionBinder* b) {
  b->Add("threshold.adaptive", threshold->adaptive,
         "Learn the threshold from how far predictions were off; false keeps initial_m.");
  b->Add("threshold.initial_m", threshold->initial_m, Range<double>{1e-3, 100.0},
         "Used until there is evidence.");
  b->Add("threshold.min_m", threshold->min_m, Range<double>{1e-3, 100.0},
         "Never smaller than this.");
  b->Add("threshold.max_m", threshold->max_m, Range<double>{1e-3, 100.0},
         "Never larger than this.");
  b->Add("threshold.min_motion_m", threshold->min_motion_m, Range<double>{0.0, 10.0},
         "Prediction errors below this say nothing about what is needed.");
  b->Add("threshold.range_m", threshold->range_m, Range<double>{0.1, 1e3},
         "Lever arm with which a rotation error counts.");
  b->Add("threshold.forgetting", threshold->forgetting, Range<double>{1e-6, 1.0},
         "Share of the newest error in the running mean of squares.");
}

void BindWeights(WeightOptions* weights, OptionBinder* b) {
  b->Add("weights.registration_sigma_m", weights->registration_sigma_m, Range<double>{1e-4, 10.0},
         "Sigma of a point's distance to its plane (paper: covariance 0.1).");
  b->Add("weights.kernel", weights->kernel, kKernels, "Robust kernel on that distance.");
  b->Add("weights.kernel_in_thresholds", weights->kernel_in_thresholds, Range<double>{1e-3, 100.0},
         "Width of the kernel: this share of the adaptive threshold, within the bounds below.");
  b->Add("weights.min_kernel_m", weights->min_kernel_m, Range<double>{1e-3, 100.0},
         "The kernel is never narrower.");
  b->Add("weights.max_kernel_m", weights->max_kernel_m, Range<double>{1e-3, 100.0},
         "The kernel is never wider.");
  b->Add("weights.smoothness_sigma_translation_m", weights->smoothness_sigma_translation_m,
         Range<double>{1e-6, 1e3},
         "Sigma of a segment's change of translation against the one before (paper: covariance "
         "0.05). A start only, unless weight_balance.enabled is false.");
  b->Add("weights.smoothness_sigma_rotation_rad", weights->smoothness_sigma_rotation_rad,
         Range<double>{1e-6, 1e3}, "The same for the rotation.");
  b->Add("weights.smoothness_interval_s", weights->smoothness_interval_s, Range<double>{1e-4, 10.0},
         "The sigmas are meant for segments up to this long; for longer ones they grow with the "
         "square of the interval, as the way does that an acceleration changes.");
  b->Add("weights.smoothness_scales_with_points", weights->smoothness_scales_with_points,
         "Divides both by the root of the summed weights of the segment's associated points, so "
         "that the balance between geometry and motion does not depend on the density of the "
         "sensor.");
}

void BindWeightBalance(WeightBalanceOptions* balance, OptionBinder* b) {
  b->Add("weight_balance.enabled", balance->enabled,
         "Lets the smoothness sigmas find themselves from the residuals of the last seconds "
         "(variance components); the configured ones are where they start.");
  b->Add("weight_balance.memory_s", balance->memory_s, Range<double>{0.01, 1e6},
         "Time over which residuals are remembered.");
  b->Add("weight_balance.prior_s", balance->prior_s, Range<double>{0.0, 1e6},
         "The configured sigmas count like residuals of this much time that agree with them.");
  b->Add("weight_balance.points_per_error", balance->points_per_error, Range<double>{1.0, 1e6},
         "Points that hit the same surfaces of the map share its errors: so many count as one.");
  b->Add("weight_balance.max_factor", balance->max_factor, Range<double>{1.0, 1e4},
         "The sigmas stay within this factor of the configured ones.");
}

}  // namespace trajlo
