// SPDX-License-Identifier: MIT
#include "core/simulation/sensors/laser_error.h"

#include <Eigen/Geometry>

#include "core/simulation/random/counter_random.h"

namespace trajlo::simulation {

std::vector<LaserError> DrawLaserErrors(const SensorModel& sensor, std::uint64_t seed,
                                        int lidar_id) {
  constexpr std::uint64_t kStream = 0x6c61736572ULL;  // Apart from the noise of the points.
  const MeasurementModel& model = sensor.measurement;
  std::vector<LaserError> errors;
  for (int laser = 0; laser < sensor.pattern->lasers(); ++laser) {
    CounterRandom random(seed, static_cast<std::uint64_t>(lidar_id), kStream,
                         static_cast<std::uint64_t>(laser));
    errors.push_back({model.laser_range_sigma_m * random.Gaussian(),
                      model.laser_angle_sigma_rad * random.Gaussian(),
                      model.laser_angle_sigma_rad * random.Gaussian()});
  }
  return errors;
}

Eigen::Vector3d Turned(const Eigen::Vector3d& direction, double up_rad, double left_rad) {
  if (up_rad == 0.0 && left_rad == 0.0) return direction;
  const Eigen::Vector3d across = Eigen::Vector3d::UnitZ().cross(direction);
  const Eigen::Vector3d left =
      across.norm() > 1e-6 ? across.normalized() : direction.unitOrthogonal();
  const Eigen::Vector3d up = direction.cross(left);
  return (direction + up_rad * up + left_rad * left).normalized();
}

}  // namespace trajlo::simulation
