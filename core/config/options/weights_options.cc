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

const Names<MotionPriorKind> kMotionPriors = {
    {"white_noise_acceleration", MotionPriorKind::kWhiteNoiseAcceleration},
    {"pseudo_velocity", MotionPriorKind::kPseudoVelocity}};

}  // namespace

void BindRegistration(RegistrationOptions* registration, OptionBinder* b) {
  b->Add("registration.sigma_m", registration->sigma_m, Range<double>{1e-4, 10.0},
         "Standard deviation of a point's distance to its plane.");
  b->Add("registration.points_per_error", registration->points_per_error, Range<double>{1.0, 1e6},
         "Points that hit the same surface share its error: so many count as one.");
  b->Add("registration.kernel", registration->kernel, kKernels, "Robust kernel on that distance.");
  b->Add("registration.kernel_m", registration->kernel_m, Range<double>{1e-3, 100.0},
         "Width of the kernel.");
}

void BindMotionPrior(MotionPriorOptions* prior, OptionBinder* b) {
  b->Add("motion_prior.kind", prior->kind, kMotionPriors,
         "White noise on acceleration, which ties neighbouring segments, or the paper's "
         "pseudo-velocity, which ties a segment to the last estimate of the one before.");
  b->Add("motion_prior.self_tuning", prior->self_tuning,
         "Lets the two densities below follow the motion; false keeps them.");
  b->Add("motion_prior.translation_m2_s3", prior->translation_m2_s3, Range<double>{1e-9, 1e9},
         "Spectral density of the acceleration: how freely the body moves. 1.5 times the squared "
         "change of a segment's translation, by the cube of its length.");
  b->Add("motion_prior.rotation_rad2_s3", prior->rotation_rad2_s3, Range<double>{1e-9, 1e9},
         "The same for rotation.");
  b->Add("motion_prior.min_translation_m2_s3", prior->min_translation_m2_s3,
         Range<double>{1e-9, 1e9}, "Self-tuning never goes below this.");
  b->Add("motion_prior.min_rotation_rad2_s3", prior->min_rotation_rad2_s3, Range<double>{1e-9, 1e9},
         "The same for rotation.");
}

}  // namespace trajlo
