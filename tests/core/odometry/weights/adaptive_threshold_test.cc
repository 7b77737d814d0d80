// SPDX-License-Identifier: MIT
#include "core/odometry/weights/adaptive_threshold.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace trajlo {
namespace {

SE3 Error(double metres) { return SE3(Eigen::Quaterniond::Identity(), {metres, 0, 0}); }

TEST(AdaptiveThreshold, FollowsThePredictionErrorsWithinItsBounds) {
  AdaptiveThresholdOptions options;
  AdaptiveThreshold threshold(options);
  EXPECT_DOUBLE_EQ(threshold.threshold_m(), options.initial_m);
  for (int i = 0; i < 1000; ++i) threshold.AddPredictionError(Error(0.5));
  EXPECT_NEAR(threshold.threshold_m(), 0.5, 1e-3);
  for (int i = 0; i < 1000; ++i) threshold.AddPredictionError(Error(50.0));
  EXPECT_DOUBLE_EQ(threshold.threshold_m(), options.max_m);
}

TEST(AdaptiveThreshold, StaysFiniteWhenPredictionsArePerfectOrNotANumber) {
  AdaptiveThresholdOptions options;
  AdaptiveThreshold threshold(options);
  for (int i = 0; i < 100; ++i) threshold.AddPredictionError(SE3());
  threshold.AddPredictionError(Error(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_DOUBLE_EQ(threshold.threshold_m(), options.initial_m);
}

TEST(AdaptiveThreshold, CanBeFixed) {
  AdaptiveThresholdOptions options;
  options.adaptive = false;
  AdaptiveThreshold threshold(options);
  for (int i = 0; i < 100; ++i) threshold.AddPredictionError(Error(5.0));
  EXPECT_DOUBLE_EQ(threshold.threshold_m(), options.initial_m);
}

}  // namespace
}  // namespace trajlo
