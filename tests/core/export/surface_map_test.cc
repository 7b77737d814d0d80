// SPDX-License-Identifier: MIT
#include "core/export/surface_map.h"

#include <gmock/gmock.h>

#include "core/export/map_file.h"
#include "core/io/errors.h"
#include "core/io/point_file.h"
#include "tests/support/random_poses.h"
#include "tests/support/temp_folder.h"

namespace trajlo::testing {
namespace {

/// Points on the plane through `center` with that normal, seen from `sensor`.
PlacedScan Plane(const Eigen::Vector3d& center, const Eigen::Vector3d& normal,
                 const Eigen::Vector3d& sensor) {
  Random random(3);
  const Eigen::Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  PlacedScan scan;
  scan.t_ns = 5;
  scan.T_world_body.t = sensor;
  for (int i = 0; i < 20000; ++i) {
    scan.points_world_m.emplace_back(center + random.Uniform(-2.0, 2.0) * u +
                                     random.Uniform(-2.0, 2.0) * v);
    scan.intensities.push_back(i % 2 == 0 ? 10.0F : 30.0F);
  }
  return scan;
}

TEST(SurfaceMap, NormalsOfAPlaneAreItsNormalTowardsTheSensor) {
  const Eigen::Vector3d normal = Eigen::Vector3d(1.0, -2.0, 0.5).normalized();
  // Far from the origin, where single precision is coarse.
  const Eigen::Vector3d center(5000.0, -300.0, 40.0);
  for (const double side : {1.0, -1.0}) {
    SurfaceMap map(0.2);
    map.Add(Plane(center, normal, center + side * 3.0 * normal));
    const std::vector<Surfel> surfels = map.Surfels();
    EXPECT_EQ(surfels.size(), map.size());
    EXPECT_GT(surfels.size(), 400u);
    double intensity = 0.0;
    for (const Surfel& surfel : surfels) {
      EXPECT_NEAR(surfel.normal.cast<double>().dot(side * normal), 1.0, 1e-4);
      EXPECT_NEAR(surfel.curvature, 0.0F, 1e-4F);
      EXPECT_NEAR((surfel.p_world_m - center).dot(normal), 0.0, 1e-9);
      EXPECT_EQ(surfel.seen_ns, 5);
      intensity += surfel.intensity;
    }
    EXPECT_NEAR(intensity / static_cast<double>(surfels.size()), 20.0, 1.0);
  }
}

TEST(SurfaceMap, HasOneSurfelForEachVoxelAtTheMeanOfItsPoints) {
  SurfaceMap map(1.0);
  PlacedScan scan;
  scan.points_world_m = {{0.1, 0.1, 0.1}, {0.3, 0.9, 0.5}, {1.5, 0.5, 0.5}, {-0.1, 0.5, 0.5}};
  scan.intensities = {1.0F, 3.0F, 7.0F, 9.0F};
  map.Add(scan);
  const std::vector<Surfel> surfels = map.Surfels();
  ASSERT_EQ(surfels.size(), 3u);
  EXPECT_NEAR((surfels[0].p_world_m - Eigen::Vector3d(0.2, 0.5, 0.3)).norm(), 0.0, 1e-12);
  EXPECT_EQ(surfels[0].intensity, 2.0F);
  // Too few neighbours for a normal.
  EXPECT_EQ(surfels[0].normal.norm(), 0.0F);
}

TEST(Coloring, SpansTheScaleFromTheLowestToTheHighest) {
  std::vector<Surfel> surfels(101);
  for (std::size_t i = 0; i < surfels.size(); ++i) {
    surfels[i].p_world_m.z() = static_cast<double>(i);
    surfels[i].intensity = static_cast<float>(100 - i);
  }
  const std::vector<Rgb> by_height = ColorsOf(surfels, ColorBy::kHeight);
  const std::vector<Rgb> by_intensity = ColorsOf(surfels, ColorBy::kIntensity);
  EXPECT_EQ(by_height.front(), Turbo(0.0));
  EXPECT_EQ(by_height.back(), Turbo(1.0));
  EXPECT_EQ(by_height[50], Turbo(0.5));
  for (std::size_t i = 0; i < surfels.size(); ++i) EXPECT_EQ(by_intensity[i], by_height[100 - i]);
  EXPECT_EQ(ColorsOf(surfels, ColorBy::kTime).front(), Turbo(0.0));  // All at once.
  EXPECT_TRUE(ColorsOf({}, ColorBy::kHeight).empty());
}

std::vector<double> ValuesOf(const PointTable& table, const char* name) {
  const Column* column = table.Find(name);
  EXPECT_NE(column, nullptr) << name;
  std::vector<double> values(column == nullptr ? 0 : table.count);
  if (column == nullptr) return values;
  VisitColumn(table, *column, 0, table.count,
              [&](std::size_t i, auto value) { values[i] = static_cast<double>(value); });
  return values;
}

TEST(MapFile, PcdAndPlyHoldTheSameNumbers) {
  const TempFolder folder;
  Surfel surfel;
  surfel.p_world_m = {1.0, -2.0, 3.5};
  surfel.intensity = 17.0F;
  surfel.normal = {0.0F, 0.6F, -0.8F};
  surfel.curvature = 0.25F;
  const std::vector<Surfel> surfels = {surfel, Surfel()};
  const std::vector<Rgb> colors = {{1, 2, 3}, {250, 128, 0}};
  for (const char* name : {"map.pcd", "map.ply"}) {
    WriteMapFile(folder / name, surfels, colors);
    const PointTable table = ReadPointFile(folder / name);
    ASSERT_EQ(table.count, 2u);
    const bool is_pcd = std::string(name) == "map.pcd";
    EXPECT_EQ(ValuesOf(table, "x")[0], 1.0);
    EXPECT_EQ(ValuesOf(table, "z")[0], 3.5);
    EXPECT_EQ(ValuesOf(table, "intensity")[0], 17.0);
    EXPECT_FLOAT_EQ(ValuesOf(table, is_pcd ? "normal_z" : "nz")[0], -0.8F);
    EXPECT_EQ(ValuesOf(table, "curvature")[0], 0.25);
    if (is_pcd) {
      EXPECT_EQ(ValuesOf(table, "rgb"), (std::vector<double>{0x010203, 0xfa8000}));
    } else {
      EXPECT_EQ(ValuesOf(table, "red"), (std::vector<double>{1, 250}));
      EXPECT_EQ(ValuesOf(table, "blue"), (std::vector<double>{3, 0}));
    }
  }
  EXPECT_THROW(WriteMapFile(folder / "map.las", surfels, colors), OutputError);
  EXPECT_THROW(WriteMapFile(folder / "map.ply", surfels, colors), OutputError);
  EXPECT_THROW(WriteMapFile("/dev/full/map.ply", surfels, colors), OutputError);
}

}  // namespace
}  // namespace trajlo::testing
