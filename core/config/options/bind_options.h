// SPDX-License-Identifier: MIT
#pragma once

#include "core/config/config.h"

namespace trajlo {

class OptionBinder;

// Each adds the options of one or a few sections, in the order of the dump.
void BindInput(RecordingOptions* input, OptionBinder* b);
void BindSensing(SegmenterOptions* segmenter, OptionBinder* b);
void BindMap(MapPyramidOptions* pyramid, OptionBinder* b);
void BindRegistration(RegistrationOptions* registration, OptionBinder* b);
void BindMotionPrior(MotionPriorOptions* prior, OptionBinder* b);
void BindSolver(SolverOptions* solver, CeresFormOptions* form, OptionBinder* b);
void BindMarginalization(MarginalizationOptions* marginalization, OptionBinder* b);
void BindEstimation(OdometryOptions* odometry, OptionBinder* b);

}  // namespace trajlo
