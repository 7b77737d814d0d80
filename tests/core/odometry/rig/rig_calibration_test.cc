// SPDX-License-Identifier: MIT
#include "core/odometry/rig/rig_calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/odometry/health/belief.h"
#include "tests/support/random_poses.h"

namespace trajlo {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using testing::Random;
using ::testing::SizeIs;

constexpr double kInterval_s = 0.03;

/// A rig in a room of random planes, whose LiDARs need these corrections.
class Rig {
 public:
  explicit Rig(const std::vector<LidarCorrection>& errors, unsigned seed = 1)
      : random_(seed), errors_(errors), T_world_body_(random_.Pose()) {}

  /// What the segmenter hands out while the body moves by `step`, and its times are corrected by
  /// `clocks_s`.
  SegmentCloud See(int points_per_lidar, const Vector6d& step, std::vector<double> clocks_s = {}) {
    clocks_s.resize(errors_.size());
    SegmentCloud cloud;
    cloud.begin_ns = t_ns_;
    cloud.end_ns = t_ns_ += 30'000'000;
    cloud.lidar_origins_body_m.assign(errors_.size(), Eigen::Vector3d::Zero());
    T_begin_ = T_world_body_;
    T_world_body_ = Plus(T_world_body_, step);
    for (std::size_t l = 0; l < errors_.size(); ++l) {
      cloud.corrections.push_back({SE3(), clocks_s[l]});
      const double wrong_s = clocks_s[l] - errors_[l].clock_s;
      for (int i = 0; i < points_per_lidar; ++i) {
        const Eigen::Vector3d p_body = errors_[l].T_body.Inverse() * random_.Vector(1, 15);
        const double alpha = random_.Uniform(0, 1) + wrong_s / kInterval_s;
        cloud.map_points.push_back(
            {p_body.cast<float>(), static_cast<float>(alpha), static_cast<std::uint16_t>(l)});
      }
    }
    cloud.registration_points = cloud.map_points;
    return cloud;
  }

  /// A window of that segment, at poses that are off by `pose_error`. The planes are those of the
  /// points of a rig without errors, which `noise_m` moves.
  Window Register(SegmentCloud cloud, const SE3& pose_error, double noise_m) {
    Window window;
    window.noise = {0.1, {KernelKind::kCauchy, 2.0}};
    window.begin_ns = cloud.begin_ns;
    window.T_world_begin = T_begin_ * pose_error;
    Segment segment;
    segment.T_world_end = T_world_body_ * pose_error;
    for (const SegmentPoint& seen : cloud.registration_points) {
      RegistrationPoint point;
      point.p_body_m = seen.p_body_m.cast<double>();
      point.alpha = static_cast<double>(seen.alpha);
      point.lidar = seen.lidar;
      point.normal_world = random_.Direction();
      const LidarCorrection& error = errors_[seen.lidar];
      const LidarCorrection& applied = cloud.corrections[seen.lidar];
      const double alpha = point.alpha - (applied.clock_s - error.clock_s) / kInterval_s;
      const SE3 T = T_begin_ * se3::Exp(alpha * Minus(T_world_body_, T_begin_));
      point.offset_m =
          point.normal_world.dot(T * (error.T_body * applied.T_body.Inverse() * point.p_body_m)) +
          random_.Gaussian(noise_m);
      segment.points.push_back(point);
    }
    segment.cloud = std::move(cloud);
    segment.registration =
        LinearizeSegment(segment.points, window.T_world_begin, segment.T_world_end, window.noise);
    window.segments.push_back(std::move(segment));
    return window;
  }

  Random* random() { return &random_; }

 private:
  Random random_;
  std::vector<LidarCorrection> errors_;
  SE3 T_world_body_, T_begin_;
  std::int64_t t_ns_ = 0;
};

/// Two metres a second, and turns to and fro: a steady motion cannot tell a clock from a place.
Vector6d Step(int i = 0) {
  Vector6d step;
  step << 0.06, 0.02 * std::sin(0.3 * i), 0.01, 0.0, 0.0, 0.02 * std::cos(0.1 * i);
  return step;
}

/// `segments` of a rig, registered at poses that are wrong by some centimetres.
void LearnFrom(Rig* rig, int segments, double noise_m, RigCalibration* calibration) {
  for (int i = 0; i < segments; ++i) {
    SegmentCloud cloud = rig->See(200, Step(i), calibration->Clocks_s());
    calibration->Apply(&cloud);
    if (i == 0) {
      std::vector<SegmentCloud> first = {cloud};
      calibration->Begin(&first);
      cloud = first.front();
    }
    const SE3 pose_error = se3::Exp(rig->random()->Tangent(0.03, 0.01));
    calibration->Learn(rig->Register(std::move(cloud), pose_error, noise_m));
  }
}

void ExpectNear(const LidarCorrection& found, const LidarCorrection& expected, double tolerance_m,
                double tolerance_rad, double tolerance_s) {
  const Vector6d difference = Minus(found.T_body, expected.T_body);
  EXPECT_LE(difference.head<3>().norm(), tolerance_m);
  EXPECT_LE(difference.tail<3>().norm(), tolerance_rad);
  EXPECT_LE(std::abs(found.clock_s - expected.clock_s), tolerance_s);
}

LidarCorrection RandomError(Random* random) {
  return {se3::Exp(random->Tangent(0.05, 0.03)), random->Uniform(-0.01, 0.01)};
}

TEST(RigCalibration, FindsCentimetresDegreesAndMillisecondsWhateverThePosesAre) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    Random random(seed);
    const std::vector<LidarCorrection> errors = {{}, RandomError(&random), RandomError(&random)};
    Rig rig(errors, seed);
    RigCalibration calibration(true);
    LearnFrom(&rig, 200, 0.01, &calibration);
    ExpectNear(calibration.Correction(0), {}, 0.0, 0.0, 0.0);
    for (const std::size_t l : {1u, 2u}) {
      ExpectNear(calibration.Correction(l), errors[l], 0.001, 0.0001, 0.0005);
    }
  }
}

TEST(RigCalibration, LeavesARigThatIsRightWhereItIs) {
  Rig rig({LidarCorrection(), LidarCorrection()});
  RigCalibration calibration(true);
  LearnFrom(&rig, 200, 0.01, &calibration);
  ExpectNear(calibration.Correction(1), {}, 0.001, 0.0001, 0.0005);
}

/// The pose is unknown, too: on the planes that it sees, the second LiDAR alone agrees with all.
TEST(RigCalibration, LearnsNothingFromOneLidarAlone) {
  Rig rig({{}, {se3::Exp(0.02 * Vector6d::Ones()), 0.01}});
  RigCalibration calibration(true);
  for (int i = 0; i < 50; ++i) {
    SegmentCloud cloud = rig.See(200, Step());
    calibration.Apply(&cloud);
    std::vector<SegmentCloud> first = {cloud};
    if (i == 0) calibration.Begin(&first);
    Window window = rig.Register(std::move(cloud), SE3(), 0.0);
    Segment& segment = window.segments.front();
    auto& points = segment.points;
    points.erase(std::remove_if(points.begin(), points.end(),
                                [](const RegistrationPoint& point) { return point.lidar == 0; }),
                 points.end());
    segment.registration =
        LinearizeSegment(points, window.T_world_begin, segment.T_world_end, window.noise);
    calibration.Learn(window);
  }
  ExpectNear(calibration.Correction(1), {}, 0.002, 0.001, 0.001);
}

/// A window that was put back has no registration any more; its points still have planes.
TEST(RigCalibration, LearnsNothingFromAWindowThatWasPutBack) {
  Rig rig({LidarCorrection(), LidarCorrection()});
  RigCalibration calibration(true);
  LearnFrom(&rig, 200, 0.01, &calibration);
  const LidarCorrection before = calibration.Correction(1);
  SegmentCloud cloud = rig.See(200, Step(), calibration.Clocks_s());
  calibration.Apply(&cloud);
  Window window = rig.Register(std::move(cloud), se3::Exp(Vector6d::Constant(0.1)), 0.01);
  Revert({window.T_world_begin, window.T_world_begin}, &window);
  calibration.Learn(window);
  ExpectNear(calibration.Correction(1), before, 1e-12, 1e-12, 1e-12);
}

TEST(RigCalibration, MovesPointsAndOriginsByTheCorrection) {
  Rig rig({{}, {se3::Exp(0.02 * Vector6d::Ones()), 0.01}});
  RigCalibration calibration(true);
  LearnFrom(&rig, 200, 0.0, &calibration);
  const SegmentCloud seen = rig.See(3, Step());
  SegmentCloud moved = seen;
  calibration.Apply(&moved);
  const SE3 C = calibration.Correction(1).T_body;
  ASSERT_THAT(moved.corrections, SizeIs(2));
  ExpectNear(moved.corrections[0], {}, 0.0, 0.0, 0.0);
  ExpectNear(moved.corrections[1], {C, seen.corrections[1].clock_s}, 1e-15, 1e-15, 0.0);
  EXPECT_EQ(moved.lidar_origins_body_m[0], seen.lidar_origins_body_m[0]);
  EXPECT_LT((moved.lidar_origins_body_m[1] - C * seen.lidar_origins_body_m[1]).norm(), 1e-12);
  for (std::size_t i = 0; i < seen.registration_points.size(); ++i) {
    const Eigen::Vector3f p = seen.registration_points[i].p_body_m;
    const Eigen::Vector3f expected =
        seen.registration_points[i].lidar == 0 ? p : (C * p.cast<double>()).cast<float>();
    EXPECT_EQ(moved.registration_points[i].p_body_m, expected);
    EXPECT_EQ(moved.map_points[i].p_body_m, expected);
  }
}

/// Each is one instant, and its clock moves no point.
TEST(RigCalibration, ScansWithoutPointTimesTellNothingOfClocks) {
  Rig rig({{}, {se3::Exp(0.02 * Vector6d::Ones()), 0.01}});
  RigCalibration calibration(true);
  for (int i = 0; i < 50; ++i) {
    SegmentCloud cloud = rig.See(100, Step(i));
    for (SegmentPoint& point : cloud.map_points) point.alpha = 1.0F;
    cloud.is_instant = true;
    calibration.Apply(&cloud);
    std::vector<SegmentCloud> first = {cloud};
    if (i == 0) calibration.Begin(&first);
    calibration.Learn(rig.Register(std::move(cloud), SE3(), 0.01));
  }
  EXPECT_GT(calibration.Correction(1).T_body.t.norm(), 0.02);
  EXPECT_EQ(calibration.Correction(1).clock_s, 0.0);
}

std::vector<int> LidarsOf(const std::vector<SegmentPoint>& points) {
  std::vector<int> lidars;
  for (const SegmentPoint& point : points) lidars.push_back(point.lidar);
  return lidars;
}

SegmentCloud CloudOf(const std::vector<int>& lidars) {
  SegmentCloud cloud;
  cloud.lidar_origins_body_m.assign(2, Eigen::Vector3d::Zero());
  cloud.corrections.resize(2);
  for (const int lidar : lidars) {
    cloud.map_points.push_back({Eigen::Vector3f::Ones(), 0.5F, static_cast<std::uint16_t>(lidar)});
  }
  cloud.registration_points = cloud.map_points;
  return cloud;
}

/// Which of two LiDARs begin the map, where the first segments have these points.
std::vector<int> BeginsMap(const std::vector<int>& lidars) {
  RigCalibration calibration(true);
  std::vector<SegmentCloud> segments = {CloudOf(lidars)};
  calibration.Apply(&segments.front());
  calibration.Begin(&segments);
  EXPECT_EQ(LidarsOf(segments.front().registration_points), lidars);
  return LidarsOf(segments.front().map_points);
}

TEST(RigCalibration, TheReferenceIsTheFirstLidarThatSeesEnough) {
  EXPECT_THAT(BeginsMap({0, 1}), ElementsAre(0));
  EXPECT_THAT(BeginsMap({1, 1, 0}), ElementsAre(0));
  EXPECT_THAT(BeginsMap({1, 1, 0, 1}), ElementsAre(1, 1, 1));
  EXPECT_THAT(BeginsMap({1}), ElementsAre(1));
  EXPECT_THAT(BeginsMap({}), IsEmpty());
}

TEST(RigCalibration, PointsEnterTheMapWhenTheirLidarHasSeenItFromEnoughPlaces) {
  Rig rig({LidarCorrection(), LidarCorrection()});
  RigCalibration calibration(true);
  const auto may_enter = [&] {
    SegmentCloud cloud = rig.See(10, Step());
    calibration.Apply(&cloud);
    return cloud.map_points.size() == cloud.registration_points.size();
  };
  LearnFrom(&rig, 10, 0.0, &calibration);
  EXPECT_FALSE(may_enter());
  EXPECT_FALSE(calibration.IsKnown(1));
  LearnFrom(&rig, 10, 0.0, &calibration);
  EXPECT_TRUE(may_enter());
  EXPECT_TRUE(calibration.IsKnown(1));
}

TEST(RigCalibration, ABodyAtRestSeesFromOnePlaceOnly) {
  Rig rig({LidarCorrection(), LidarCorrection()});
  RigCalibration calibration(true);
  LearnFrom(&rig, 1, 0.0, &calibration);
  for (int i = 0; i < 1000; ++i) {
    SegmentCloud cloud = rig.See(10, Vector6d::Zero());
    calibration.Apply(&cloud);
    calibration.Learn(rig.Register(std::move(cloud), SE3(), 0.0));
  }
  EXPECT_FALSE(calibration.IsKnown(1));
}

/// What the map says after a rig of two was seen from 20 places; `change` does something to the
/// window's points of LiDAR 1.
RigEvidence EvidenceWhere(const std::function<void(std::vector<RegistrationPoint>*)>& change) {
  Rig rig({LidarCorrection(), LidarCorrection()});
  RigCalibration calibration(true);
  std::vector<SegmentCloud> first = {rig.See(200, Step())};
  calibration.Begin(&first);
  for (int i = 0; i < 100; ++i) {
    SegmentCloud cloud = rig.See(200, Step(i));
    calibration.Apply(&cloud);
    Window window = rig.Register(std::move(cloud), SE3(), 0.0);
    std::vector<RegistrationPoint>& points = window.segments[0].points;
    const auto second = std::stable_partition(points.begin(), points.end(),
                                              [](const auto& point) { return point.lidar == 0; });
    std::vector<RegistrationPoint> of_second(second, points.end());
    points.erase(second, points.end());
    change(&of_second);
    points.insert(points.end(), of_second.begin(), of_second.end());
    calibration.Learn(window);
  }
  EXPECT_EQ(calibration.EvidenceFor(0), RigEvidence::kConfirmed);
  EXPECT_EQ(calibration.IsKnown(1), calibration.EvidenceFor(1) >= RigEvidence::kNone);
  return calibration.EvidenceFor(1);
}

TEST(RigCalibration, ALidarWhosePointsLieBesideTheMapStaysOutOfIt) {
  Random random(3);
  const auto as_it_is = [](std::vector<RegistrationPoint>*) {};
  const auto beside = [&](std::vector<RegistrationPoint>* points) {
    for (RegistrationPoint& point : *points) point.offset_m += random.Uniform(-0.5, 0.5);
  };
  EXPECT_EQ(EvidenceWhere(as_it_is), RigEvidence::kConfirmed);
  EXPECT_EQ(EvidenceWhere(beside), RigEvidence::kContradicted);
}

/// It looks elsewhere: nothing speaks against it, and the map grows with it.
TEST(RigCalibration, ALidarThatSeesWhatNoOtherSawIsBelieved) {
  EXPECT_EQ(EvidenceWhere([](auto* points) { points->clear(); }), RigEvidence::kNone);
}

/// While the reference is silent, the map would stand still.
TEST(RigCalibration, WhereNoOtherPointsAreTheyEnterTheMap) {
  RigCalibration calibration(true);
  std::vector<SegmentCloud> segments = {CloudOf({0, 1})};
  calibration.Apply(&segments.front());
  calibration.Begin(&segments);
  SegmentCloud alone = CloudOf({1, 1});
  calibration.Apply(&alone);
  EXPECT_THAT(alone.map_points, SizeIs(2));
}

TEST(RigCalibration, WhereItIsNotToLearnNothingChanges) {
  Rig rig({{}, {se3::Exp(0.02 * Vector6d::Ones()), 0.01}});
  RigCalibration calibration(false);
  LearnFrom(&rig, 20, 0.0, &calibration);
  SegmentCloud cloud = rig.See(10, Step());
  const SegmentCloud seen = cloud;
  calibration.Apply(&cloud);
  ExpectNear(calibration.Correction(1), {}, 0.0, 0.0, 0.0);
  ASSERT_THAT(cloud.map_points, SizeIs(seen.map_points.size()));
  for (std::size_t i = 0; i < seen.map_points.size(); ++i) {
    EXPECT_EQ(cloud.map_points[i].p_body_m, seen.map_points[i].p_body_m);
  }
}

}  // namespace
}  // namespace trajlo
