// SPDX-License-Identifier: MIT
#include "core/odometry/map/seen_from.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/random_poses.h"

namespace trajlo {
namespace {

TEST(SeenFrom, IsKeptInTheCoordinatesOfAPoint) {
  testing::Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3f to_sensor =
        (random.Uniform(0.01, 100.0) * random.Direction()).cast<float>();
    const SeenFrom seen_from(to_sensor);
    Eigen::Vector3f kept;
    for (int axis = 0; axis < 3; ++axis) {
      const auto coordinate = static_cast<float>(random.Uniform(-2.0, 2.0));
      kept[axis] = seen_from.PutInto(coordinate, axis);
      EXPECT_NEAR(kept[axis], coordinate, 2e-6 * std::abs(coordinate));
    }
    const Eigen::Vector3f direction = SeenFrom::Of(kept.x(), kept.y(), kept.z()).Direction();
    EXPECT_EQ(direction, seen_from.Direction());
    EXPECT_LT((direction - to_sensor.normalized()).cwiseAbs().maxCoeff(), SeenFrom::kPrecision);
  }
}

TEST(SeenFrom, NobodyKnowsFromWhere) {
  for (const SeenFrom& seen_from : {SeenFrom(), SeenFrom(Eigen::Vector3f::Zero())}) {
    EXPECT_EQ(seen_from.Direction(), Eigen::Vector3f::Zero());
    // Numbers with few bits stay as they are.
    EXPECT_EQ(seen_from.PutInto(0.25F, 0), 0.25F);
    EXPECT_EQ(seen_from.PutInto(0.0F, 1), 0.0F);
  }
}

}  // namespace
}  // namespace trajlo
