// SPDX-License-Identifier: MIT
#include "core/simulation/simulator.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/scans/nanoseconds.h"
#include "core/simulation/point_time.h"
#include "core/simulation/random/counter_random.h"
#include "core/simulation/scan_stream.h"
#include "core/simulation/scenes/scene_builder.h"
#include "core/simulation/sensors/laser_error.h"

namespace trajlo::simulation {

using Eigen::Vector3d;

namespace {

/// A fixed number, so that the cut into tasks does not depend on the threads.
constexpr int kFiringsPerTask = 2048;

/// What comes back of a beam that has a width: of two rays in it, of which each has a random share
/// of the light. Two surfaces that are near each other return one pulse, in between.
std::optional<RayHit> CastBeam(const Scene& scene, const Vector3d& origin, const Vector3d& middle,
                               double t_s, const MeasurementModel& model, CounterRandom* random) {
  constexpr double kOnePulse_m = 0.5;
  std::optional<RayHit> hit = scene.CastRay(origin, middle, t_s, model.max_range_m);
  if (model.divergence_rad == 0.0) return hit;
  const double angle = random->Uniform(0.0, 2.0 * M_PI);
  const double radius_rad = 0.5 * model.divergence_rad * std::sqrt(random->Uniform());
  const Vector3d edge = Turned(middle, radius_rad * std::sin(angle), radius_rad * std::cos(angle));
  const std::optional<RayHit> other = scene.CastRay(origin, edge, t_s, model.max_range_m);
  const double share = random->Uniform();
  if (!hit || !other || std::abs(hit->range_m - other->range_m) > kOnePulse_m) {
    return share < 0.5 ? hit : other;
  }
  hit->range_m += share * (other->range_m - hit->range_m);
  return hit;
}

/// Replaces what a beam hit by what it met in the air before.
void AddClutter(const Vector3d& ray, const MeasurementModel& model, CounterRandom* random,
                std::optional<RayHit>* hit) {
  if (random->Uniform() >= model.clutter_fraction) return;
  const double range_m = -model.clutter_range_m * std::log(1.0 - random->Uniform());
  if (range_m > (*hit ? (*hit)->range_m : model.max_range_m)) return;
  *hit = RayHit{range_m, -ray, 0.05F};
}

}  // namespace

struct Simulator::World {
  Scene scene;
  PoseFunction T_world_body;

  static World Make(const Scenario& scenario) {
    SceneBlueprint blueprint = BuildScene(scenario.scene, scenario.seed);
    if (!scenario.moving_objects) blueprint.moving_objects.clear();
    PoseFunction motion =
        MakeMotion(scenario.motion, blueprint.routes, scenario.duration_s, scenario.seed);
    if (scenario.companion.kind != "none") {
      blueprint.moving_objects.push_back(MakeCompanion(scenario.companion, motion));
    }
    return {Scene(std::move(blueprint.mesh), std::move(blueprint.moving_objects)),
            std::move(motion)};
  }
};

Simulator::Simulator(const Scenario& scenario) : Simulator(scenario, World::Make(scenario)) {}

Simulator::Simulator(const Scenario& scenario, World world)
    : Simulator(scenario, std::move(world.scene), std::move(world.T_world_body)) {}

Simulator::Simulator(const Scenario& scenario, Scene scene, PoseFunction T_world_body)
    : scenario_(scenario),
      scene_(std::move(scene)),
      T_world_body_(std::move(T_world_body)),
      start_ns_(scenario.start_time_ns),
      end_ns_(start_ns_ + Nanoseconds(scenario.duration_s)) {
  if (scenario.rig.empty()) throw std::invalid_argument("the rig has no LiDAR");
  if (!(scenario.duration_s > 0.0)) throw std::invalid_argument("the duration must be positive");
  for (const LidarConfig& lidar : scenario.rig) {
    sensors_.push_back(MakeSensor(lidar.sensor, lidar.columns));
    sensors_.back().measurement = lidar.measurement;
    const auto id = static_cast<int>(laser_errors_.size());
    laser_errors_.push_back(DrawLaserErrors(sensors_.back(), scenario.seed, id));
  }
}

SE3 Simulator::TrueWorldFromBody(std::int64_t t_ns) const {
  return T_world_body_(Seconds(t_ns - start_ns_));
}

std::int64_t Simulator::ScanCount(int lidar_id) const {
  const auto id = static_cast<std::size_t>(lidar_id);
  const std::int64_t available_ns = end_ns_ - start_ns_ - Nanoseconds(scenario_.rig[id].phase_s);
  return std::max<std::int64_t>(0, available_ns / sensors_[id].pattern->period_ns());
}

SimulatedScan Simulator::SimulateScan(int lidar_id, std::int64_t index) const {
  const auto id = static_cast<std::size_t>(lidar_id);
  const ScanPattern& pattern = *sensors_[id].pattern;
  SimulatedScan simulated;
  simulated.index = index;
  simulated.period_ns = pattern.period_ns();
  simulated.true_start_ns =
      start_ns_ + Nanoseconds(scenario_.rig[id].phase_s) + index * pattern.period_ns();
  simulated.sweep_start_ns =
      simulated.true_start_ns + Nanoseconds(scenario_.rig[id].clock_offset_s);
  simulated.scan.lidar_id = lidar_id;
  simulated.scan.stamp_ns = simulated.sweep_start_ns;

  const int firings = pattern.firings_per_scan();
  const int tasks = (firings + kFiringsPerTask - 1) / kFiringsPerTask;
  std::vector<std::vector<LidarPoint>> parts(static_cast<std::size_t>(tasks));
  tbb::parallel_for(0, tasks, [&](int task) {
    CastFirings(lidar_id, index, task * kFiringsPerTask,
                std::min(firings, (task + 1) * kFiringsPerTask),
                &parts[static_cast<std::size_t>(task)]);
  });
  for (const std::vector<LidarPoint>& part : parts) {
    simulated.scan.points.insert(simulated.scan.points.end(), part.begin(), part.end());
  }
  if (scenario_.motion_corrected) {
    CorrectMotion(&simulated);
  } else {
    for (LidarPoint& point : simulated.scan.points) {
      point.t_ns =
          simulated.sweep_start_ns + StorableOffsetNs(point.t_ns - simulated.sweep_start_ns);
    }
  }
  return simulated;
}

void Simulator::CastFirings(int lidar_id, std::int64_t index, int first, int last,
                            std::vector<LidarPoint>* points) const {
  const auto id = static_cast<std::size_t>(lidar_id);
  const LidarConfig& lidar = scenario_.rig[id];
  const ScanPattern& pattern = *sensors_[id].pattern;
  const MeasurementModel& model = lidar.measurement;
  const std::vector<LaserError>& errors = laser_errors_[id];
  const std::int64_t begin_ns = Nanoseconds(lidar.phase_s) + index * pattern.period_ns();
  const std::int64_t stamp_ns = start_ns_ + begin_ns + Nanoseconds(lidar.clock_offset_s);
  std::int64_t pose_offset_ns = -1;
  double t_s = 0.0;
  SE3 T_world_lidar;
  points->reserve(static_cast<std::size_t>(last - first));
  for (int i = first; i < last; ++i) {
    const Firing firing = pattern.At(index, i);
    if (firing.offset_ns != pose_offset_ns) {  // The beams of a column may share their time.
      pose_offset_ns = firing.offset_ns;
      t_s = Seconds(begin_ns + firing.offset_ns);
      T_world_lidar = T_world_body_(t_s) * lidar.T_body_lidar;
    }
    CounterRandom random(scenario_.seed, static_cast<std::uint64_t>(lidar_id),
                         static_cast<std::uint64_t>(index), static_cast<std::uint64_t>(i));
    if (random.Uniform() < model.dropout_fraction) continue;
    const LaserError& error = errors[static_cast<std::size_t>(i) % errors.size()];
    const double range_error_m = error.range_m + model.range_sigma_m * random.Gaussian();
    const double up_rad = error.up_rad + model.angle_sigma_rad * random.Gaussian();
    const double left_rad = error.left_rad + model.angle_sigma_rad * random.Gaussian();
    const Vector3d ray = T_world_lidar.q * Turned(firing.direction, up_rad, left_rad);
    std::optional<RayHit> hit = CastBeam(scene_, T_world_lidar.t, ray, t_s, model, &random);
    if (model.clutter_fraction > 0.0) AddClutter(ray, model, &random, &hit);
    if (!hit || hit->range_m < model.min_range_m) continue;
    LidarPoint point;
    point.xyz_m = (firing.direction * (hit->range_m + range_error_m)).cast<float>();
    // A diffuse surface: what comes back falls with the cosine of the angle of incidence. The
    // sensors compensate for the distance.
    point.intensity = 255.0F * hit->reflectivity * static_cast<float>(-hit->normal.dot(ray));
    point.t_ns = stamp_ns + firing.offset_ns;
    points->push_back(point);
  }
}

void Simulator::CorrectMotion(SimulatedScan* simulated) const {
  LidarScan& scan = simulated->scan;
  const SE3& T_body_lidar = scenario_.rig[static_cast<std::size_t>(scan.lidar_id)].T_body_lidar;
  const std::int64_t to_true_ns = simulated->true_start_ns - simulated->sweep_start_ns;
  const std::int64_t middle_ns = simulated->sweep_start_ns + simulated->period_ns / 2;
  const SE3 T_middle_world = (TrueWorldFromBody(middle_ns + to_true_ns) * T_body_lidar).Inverse();
  std::int64_t pose_t_ns = -1;
  SE3 T_middle_lidar;
  for (LidarPoint& point : scan.points) {
    if (point.t_ns != pose_t_ns) {
      pose_t_ns = point.t_ns;
      T_middle_lidar = T_middle_world * TrueWorldFromBody(pose_t_ns + to_true_ns) * T_body_lidar;
    }
    point.xyz_m = (T_middle_lidar * point.xyz_m.cast<double>()).cast<float>();
    point.t_ns = middle_ns;
  }
  scan.stamp_ns = middle_ns;
  scan.has_point_times = false;
  simulated->sweep_start_ns = middle_ns;
}

void SimulateScans(const Simulator& simulator, int threads,
                   const std::function<void(const SimulatedScan&)>& consume) {
  ScanStream stream(simulator, threads);
  for (SimulatedScan simulated; stream.Next(&simulated);) consume(simulated);
}

void SimulateScans(const Scenario& scenario, int threads,
                   const std::function<void(const SimulatedScan&)>& consume) {
  SimulateScans(Simulator(scenario), threads, consume);
}

}  // namespace trajlo::simulation
