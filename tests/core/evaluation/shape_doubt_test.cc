// SPDX-License-Identifier: MIT
#include "core/evaluation/shape_doubt.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>
#include <utility>

namespace trajlo::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A walk through a room, and 1 mm of error in each coordinate.
constexpr double kWalk_m = 3.0;
constexpr double kError_m = 0.001;

/// On a curve of this size, the estimate with errors of its own.
std::vector<PosePair> Pairs(double size_m, double error_m) {
  std::mt19937 engine(1);
  std::normal_distribution<double> error(0.0, error_m);
  std::vector<PosePair> pairs(300);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const double s = 0.05 * static_cast<double>(i);
    const Eigen::Vector3d place =
        size_m * Eigen::Vector3d(std::sin(s), std::cos(0.7 * s), 0.3 * std::sin(1.9 * s));
    pairs[i].truth = Eigen::Translation3d(place);
    pairs[i].estimate =
        Eigen::Translation3d(place + Eigen::Vector3d(error(engine), error(engine), error(engine)));
  }
  return pairs;
}

std::vector<PosePair> InMillimetres(std::vector<PosePair> pairs) {
  for (PosePair& pair : pairs) pair.truth.translation() *= 1000.0;
  return pairs;
}

TEST(JudgeShape, AWalkHasNothingOddUnlessItsTruthIsInAnotherUnit) {
  EXPECT_THAT(JudgeShape(Pairs(kWalk_m, kError_m), false), IsEmpty());
  EXPECT_THAT(JudgeShape(InMillimetres(Pairs(kWalk_m, kError_m)), false),
              ElementsAre(HasSubstr("about 1000 times as large")));
  EXPECT_THAT(JudgeShape(InMillimetres(Pairs(kWalk_m, kError_m)), true), IsEmpty());
}

TEST(JudgeShape, ABodyThatHardlyMovesIsOfNoOtherUnit) {
  // The errors are all that the estimate has, so that the best scale is near zero.
  for (const double size_m : {1e-6, 1e-5, 1e-4}) {
    EXPECT_THAT(JudgeShape(Pairs(size_m, kError_m), false), IsEmpty()) << size_m;
    std::vector<PosePair> swapped = Pairs(size_m, kError_m);
    for (PosePair& pair : swapped) std::swap(pair.estimate, pair.truth);
    EXPECT_THAT(JudgeShape(swapped, false), IsEmpty()) << size_m;
  }
}

}  // namespace
}  // namespace trajlo::testing
