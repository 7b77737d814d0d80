// SPDX-License-Identifier: MIT
#pragma once

#include "core/config/config.h"

namespace trajlo {

class OptionBinder;

// Each adds the options of one or a few sections, in the order of the dump.
void BindInput(RecordingOptions* input, OptionBinder* b);
void BindSensing(SegmenterOptions* segmenter, OptionBinder* b);
void BindAdaptiveInterval(AdaptiveIntervalOptions* interval, OptionBinder* b);
void BindMap(MapPyramidOptions* pyramid, OptionBinder* b);
void BindThreshold(AdaptiveThresholdOptions* threshold, OptionBinder* b);
void BindWeights(WeightOptions* weights, OptionBinder* b);
void BindWeightBalance(WeightBalanceOptions* balance, OptionBinder* b);
void BindSolver(SolverOptions* solver, OptionBinder* b);
void BindMarginalization(MarginalizationOptions* marginalization, OptionBinder* b);
void BindEstimation(OdometryOptions* odometry, OptionBinder* b);

}  // namespace trajlo
