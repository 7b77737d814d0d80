// SPDX-License-Identifier: MIT
// Covariances are those of the change between two poses a second apart, in every scene, at rest and
// in motion: scripts/covariance_table has the same experiment with more seeds.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/support/simulated_run.h"

namespace trajlo {
namespace {

using testing::SimulatedRun;

constexpr double kApart_s = 1.0;

/// e' C^-1 e / 6 in the mean over all pairs of poses a second apart from `begin_s` on, with
/// true A^-1 B = (A^-1 B) Exp(e) and C = C_B + Ad C_A Ad', Ad of B^-1 A.
double NormalisedErrorSquared(const SimulatedRun& run, double begin_s) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t a = 1, b = 1; b < run.poses.size(); ++b) {
    while (run.Time_s(b) - run.Time_s(a + 1) >= kApart_s) ++a;
    if (run.Time_s(a) < begin_s || run.Time_s(b) - run.Time_s(a) < kApart_s) continue;
    const SE3 estimated = run.poses[a].T_world_body.Inverse() * run.poses[b].T_world_body;
    const Vector6d e = Minus(run.truth[a].Inverse() * run.truth[b], estimated);
    const Matrix6d Ad = se3::Adjoint(estimated.Inverse());
    const Matrix6d C = run.covariances[b] + Ad * run.covariances[a] * Ad.transpose();
    sum += e.dot(C.ldlt().solve(e)) / 6.0;
    ++count;
  }
  return sum / count;
}

/// The mean over scenes and seeds, and every scene by itself within `factor`.
double MeanOver(const std::vector<std::string>& scenarios, bool is_still, double factor) {
  double sum = 0.0;
  for (const std::string& name : scenarios) {
    double of_scene = 0.0;
    for (const std::uint64_t seed : {1, 2}) {
      simulation::Scenario scenario = simulation::MakeScenario(name);
      scenario.seed = is_still ? seed : seed + 10;
      scenario.duration_s = is_still ? 4.0 : 6.0;
      scenario.motion.rest_s = 1.0;
      if (is_still) scenario.motion.kind = "still";
      of_scene += 0.5 * NormalisedErrorSquared(SimulatedRun(scenario), is_still ? 0.5 : 1.5);
    }
    std::printf("%-20s %-9s %.2f\n", name.c_str(), is_still ? "at rest" : "in motion", of_scene);
    EXPECT_GT(of_scene, 1.0 / factor) << name;
    EXPECT_LT(of_scene, factor) << name;
    sum += of_scene;
  }
  return sum / static_cast<double>(scenarios.size());
}

const std::vector<std::string> kScenarios = {"hall_os1_16",   "courtyard_os1_16", "office_os0_64",
                                             "facade_os1_16", "corridor_vlp16",   "street_hdl64"};

// A calibration that is off by four fails: no mean that it would have is within the bounds.

TEST(Covariances, AreRightAtRest) {
  const double mean = MeanOver(kScenarios, true, 4.0);
  EXPECT_GT(mean, 0.5);
  EXPECT_LT(mean, 2.0);
}

TEST(Covariances, AreRightInMotion) {
  const double mean = MeanOver(kScenarios, false, 4.0);
  EXPECT_GT(mean, 0.5);
  EXPECT_LT(mean, 2.0);
}

}  // namespace
}  // namespace trajlo
