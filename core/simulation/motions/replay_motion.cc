// SPDX-License-Identifier: MIT
// Replays a trajectory file through a smooth spline.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/io/format_text.h"
#include "core/io/stamp_text.h"
#include "core/io/trajectory_reader.h"
#include "core/scans/nanoseconds.h"
#include "core/simulation/motions/motion_makers.h"

namespace trajlo::simulation {

namespace {

/// x, y, z and the quaternion as 7 numbers: normalising the spline of a quaternion whose signs are
/// consistent gives a rotation that is as smooth, and exact at the given poses.
using Vector7d = Eigen::Matrix<double, 7, 1>;

/// A natural cubic spline: through all points, twice continuously differentiable.
class CubicSpline {
 public:
  CubicSpline(std::vector<double> t, std::vector<Vector7d> y) : t_(std::move(t)), y_(std::move(y)) {
    // The tridiagonal system of the second derivatives m, solved by Thomas's algorithm.
    const std::size_t n = t_.size();
    m_.assign(n, Vector7d::Zero());
    std::vector<double> c(n, 0.0);
    for (std::size_t i = 1; i + 1 < n; ++i) {
      const double h0 = t_[i] - t_[i - 1];
      const double h1 = t_[i + 1] - t_[i];
      const Vector7d slopes = 6.0 * ((y_[i + 1] - y_[i]) / h1 - (y_[i] - y_[i - 1]) / h0);
      const double pivot = 2.0 * (h0 + h1) - h0 * c[i - 1];
      c[i] = h1 / pivot;
      m_[i] = (slopes - h0 * m_[i - 1]) / pivot;
    }
    for (std::size_t i = n - 1; i-- > 1;) m_[i] -= c[i] * m_[i + 1];
  }

  double end() const { return t_.back(); }

  Vector7d Value(double t) const {
    t = std::clamp(t, t_.front(), t_.back());
    const auto next = std::upper_bound(t_.begin() + 1, t_.end() - 1, t);
    const auto i = static_cast<std::size_t>(next - t_.begin()) - 1;
    const double h = t_[i + 1] - t_[i];
    const double b = (t - t_[i]) / h;
    const double a = 1.0 - b;
    return a * y_[i] + b * y_[i + 1] +
           h * h / 6.0 * ((a * a * a - a) * m_[i] + (b * b * b - b) * m_[i + 1]);
  }

 private:
  std::vector<double> t_;
  std::vector<Vector7d> y_;
  std::vector<Vector7d> m_;
};

CubicSpline ReadSpline(const std::string& path) {
  std::vector<std::string> warnings;
  const std::vector<StampedPose> file = ReadTum(path, &warnings);
  // Exactly the file is flown, or nothing.
  if (!warnings.empty()) throw std::runtime_error(warnings.front());
  if (file.size() < 2) throw std::runtime_error(path + ": a replay needs at least two poses");
  std::vector<double> times;
  std::vector<Vector7d> poses;
  for (const StampedPose& stamped : file) {
    const double t = Seconds(stamped.t_ns - file.front().t_ns);
    if (!times.empty() && t <= times.back()) {
      throw std::runtime_error(path + ": the pose at " + FormatSeconds(stamped.t_ns) +
                               " s does not come after the one before it");
    }
    Vector7d pose;
    pose << stamped.T_world_body.t, stamped.T_world_body.q.coeffs();
    if (!poses.empty() && pose.tail<4>().dot(poses.back().tail<4>()) < 0.0) {
      pose.tail<4>() = -pose.tail<4>();
    }
    times.push_back(t);
    poses.push_back(pose);
  }
  return {std::move(times), std::move(poses)};
}

}  // namespace

PoseFunction MakeReplay(const MotionConfig& config, const SceneRoutes& routes, double duration_s) {
  const CubicSpline spline = ReadSpline(config.replay_file);
  if (spline.end() < duration_s - 1e-6) {
    const double longest_s = std::floor(1000.0 * spline.end()) / 1000.0;
    throw std::runtime_error(config.replay_file +
                             FormatText(": holds %.3f s, and the recording would last %.3f s; give "
                                        "a duration_s of at most %.3f",
                                        longest_s, duration_s, longest_s));
  }
  const auto T_file_body = [spline](double t) {
    const Vector7d x = spline.Value(t);
    return SE3(Eigen::Quaterniond(x[6], x[3], x[4], x[5]).normalized(), x.head<3>());
  };
  SE3 T_world_file;
  if (config.replay_placed) {
    // Only a turn about the vertical: what is level in the file stays level.
    const SE3 start = T_file_body(0.0);
    const Eigen::Vector3d forward = start.q * Eigen::Vector3d::UnitX();
    const SE3 spot = SpotOfFlight(routes, config.height_m);
    const Eigen::Quaterniond level(
        Eigen::AngleAxisd(std::atan2(forward.y(), forward.x()), Eigen::Vector3d::UnitZ()));
    T_world_file = spot * SE3(level, start.t).Inverse();
  }
  return [=](double t) { return T_world_file * T_file_body(t); };
}

}  // namespace trajlo::simulation
