// SPDX-License-Identifier: MIT
#include "core/simulation/scenes/scene.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "core/simulation/random/counter_random.h"
#include "core/simulation/scenes/scene_builder.h"
#include "tests/core/simulation/hollow_cube.h"

namespace trajlo::simulation {
namespace {

using Eigen::Vector3d;

Vector3d RandomDirection(CounterRandom* random) {
  Vector3d direction;
  for (double& component : direction) component = random->Gaussian();
  return direction.normalized();
}

TEST(Scene, RaysHitAHollowCubeWhereTheFormulaSays) {
  const Scene cube = MakeHollowCube();
  CounterRandom random(1);
  for (int i = 0; i < 2000; ++i) {
    Vector3d origin;
    for (double& coordinate : origin) coordinate = random.Uniform(-4.9, 4.9);
    const Vector3d direction = RandomDirection(&random);
    const auto hit = cube.CastRay(origin, direction, 0.0, 100.0);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->range_m, CubeRange(origin, direction), 1e-5);
    EXPECT_NEAR(hit->normal.norm(), 1.0, 1e-9);
    EXPECT_LT(hit->normal.dot(direction), 0.0);
    EXPECT_FLOAT_EQ(hit->reflectivity, 0.5F);
  }
}

TEST(Scene, RaysAlongEdgesAndCornersDoNotSlipThrough) {
  const Scene cube = MakeHollowCube();
  for (const double x : {-1.0, 0.0, 1.0}) {
    for (const double y : {-1.0, 0.0, 1.0}) {
      for (const double z : {-1.0, 0.0, 1.0}) {
        if (x == 0.0 && y == 0.0 && z == 0.0) continue;
        const Vector3d direction = Vector3d(x, y, z).normalized();
        EXPECT_TRUE(cube.CastRay(Vector3d::Zero(), direction, 0.0, 100.0)) << direction.transpose();
      }
    }
  }
}

TEST(Scene, NothingIsHitBeyondTheMaximumRange) {
  const Scene cube = MakeHollowCube();
  EXPECT_FALSE(cube.CastRay(Vector3d::Zero(), Vector3d::UnitX(), 0.0, 4.99));
  EXPECT_TRUE(cube.CastRay(Vector3d::Zero(), Vector3d::UnitX(), 0.0, 5.01));
}

TEST(Scene, AMovingObjectIsWhereItIsAtTheTimeOfTheRay) {
  TriangleMesh fixed;
  fixed.AddBox(Vector3d::Constant(-50.0), Vector3d::Constant(50.0), 0.5);
  TriangleMesh ball;
  ball.AddBox(Vector3d::Constant(-0.5), Vector3d::Constant(0.5), 0.9);
  std::vector<MovingObject> moving;
  moving.push_back({ball, [](double t) {
                      return SE3(Eigen::Quaterniond::Identity(), {10.0 + 2.0 * t, 0, 0});
                    }});
  const Scene scene(std::move(fixed), std::move(moving));
  EXPECT_NEAR(scene.CastRay(Vector3d::Zero(), Vector3d::UnitX(), 0.0, 100.0)->range_m, 9.5, 1e-6);
  EXPECT_NEAR(scene.CastRay(Vector3d::Zero(), Vector3d::UnitX(), 3.0, 100.0)->range_m, 15.5, 1e-6);
  EXPECT_NEAR(scene.CastRay(Vector3d::Zero(), Vector3d::UnitY(), 0.0, 100.0)->range_m, 50.0, 1e-5);
}

TEST(Scene, LeavesTheThreadsOfTheProcessAlone) {
  // Embree runs on oneTBB as everything else here does, and can be told to limit it.
  const auto parallelism = [] {
    return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  };
  const std::size_t before = parallelism();
  const Scene cube = MakeHollowCube();
  EXPECT_EQ(parallelism(), before);
}

TEST(TriangleMesh, ASphereIsClosedAndOfItsRadius) {
  TriangleMesh mesh;
  mesh.AddSphere(Vector3d(1.0, 2.0, 3.0), 2.0, 0.5, 24);
  const Scene scene(std::move(mesh));
  CounterRandom random(2);
  for (int i = 0; i < 500; ++i) {
    const auto hit = scene.CastRay(Vector3d(1.0, 2.0, 3.0), RandomDirection(&random), 0.0, 10.0);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->range_m, 2.0, 0.04);
  }
}

TEST(TriangleMesh, ACylinderIsClosedAndOfItsSize) {
  TriangleMesh mesh;
  mesh.AddCylinder({0.0, 0.0, -1.0}, {0.0, 0.0, 1.0}, 0.5, 0.5, 48);
  const Scene scene(std::move(mesh));
  EXPECT_NEAR(scene.CastRay(Vector3d::Zero(), Vector3d::UnitZ(), 0.0, 10.0)->range_m, 1.0, 1e-6);
  EXPECT_NEAR(scene.CastRay(Vector3d::Zero(), Vector3d::UnitX(), 0.0, 10.0)->range_m, 0.5, 2e-3);
}

class AnyScene : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Names, AnyScene, testing::ValuesIn(SceneNames()),
                         [](const auto& instance) { return instance.param; });

TEST_P(AnyScene, IsTheSameForTheSameSeedAndDiffersForAnother) {
  const SceneBlueprint a = BuildScene(GetParam(), 7);
  const SceneBlueprint b = BuildScene(GetParam(), 7);
  const SceneBlueprint c = BuildScene(GetParam(), 8);
  EXPECT_EQ(a.mesh.vertices, b.mesh.vertices);
  EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
  EXPECT_NE(a.mesh.vertices, c.mesh.vertices);
  EXPECT_EQ(a.mesh.reflectivity.size(), a.mesh.triangles.size());
}

TEST(BuildScene, RefusesAnUnknownName) {
  EXPECT_THROW(BuildScene("moon", 1), std::invalid_argument);
}

}  // namespace
}  // namespace trajlo::simulation
