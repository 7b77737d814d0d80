// SPDX-License-Identifier: MIT
#include "core/odometry/health/doubt.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "core/odometry/health/support.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

/// Of all points, this share must be on the map before the others extend it.
constexpr double kToExtendMap = 0.5;
/// And this share before the place is trusted. Where the map has grown at the right place, it is
/// nine of ten; where it has grown at a wrong one, much of what is seen next is not on it.
constexpr double kToTrust = 0.75;
/// Of the usual agreement: nearly all windows at the right place have this share.
constexpr double kAsUsual = 0.95;
/// With less, they contradict the map: a car at 30 m/s has 0.9 or more, a slide of 6 m at most 0.8.
constexpr double kNoContradiction = 0.85;
/// Usual until more is known: the median at the right place is above 0.85 (InlierWatch).
constexpr double kAgreementAtFirst = 0.9;
/// The usual is a mean over about this many windows.
constexpr double kWindows = 20.0;
/// What three standard deviations of an unseen motion may be without a doubt: points are still near
/// their planes. Rotations count at a distance of 2.2 m.
constexpr double kMoved_m = kOnPlane_m;
constexpr double kMoved_rad = 0.45 * kOnPlane_m;
/// A segment that is this many times as long as the one before spans a pause: two scans are
/// missing.
constexpr double kPause = 2.5;

/// All planes face one direction if the others have at most this share of their information.
constexpr double kOtherNormals = 0.02;

/// The direction that the planes of nearly all points of a segment face: only the floor is in view.
std::optional<Eigen::Vector3d> CommonNormal(const Segment& segment) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const RegistrationPoint& point : segment.points) {
    sum += point.weight * point.normal_world * point.normal_world.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(sum);
  if (!(eigen.eigenvalues()[1] < kOtherNormals * eigen.eigenvalues()[2])) return std::nullopt;
  return eigen.eigenvectors().col(2);
}

/// Whether the newest segment is much longer than the one before: nothing was measured within it.
bool IsBehindPause(const Window& window) {
  if (window.size() < 2) return false;
  const Segment& before = window.segments[window.segments.size() - 2];
  return window.segments.back().Duration_s() > kPause * before.Duration_s();
}

}  // namespace

void DoubtWatch::Update(const Window& window, const WindowStatistics& statistics,
                        const Vector6d& density) {
  const unsigned unheld = WhyUnheld(window, statistics, density);
  // At first, points that agree and leave a direction open are no reason for doubt.
  const bool began = held_until_ns_ || (unheld & ~kFlagDegenerate) != 0;
  if (unheld == 0 || !began) held_until_ns_ = window.EndNs();
  is_held_ = unheld == 0;
  if (!is_held_) {
    const bool has_jumped = (unheld & kFlagJump) != 0;
    if (flags_ != 0 || has_jumped || MayHaveMoved(window.EndNs(), density)) {
      Doubt(unheld, window, density);
    }
  } else if (flags_ == 0) {
    const double usual = UsualAgreement();
    usual_agreement_ = usual + (statistics.agreement - usual) / kWindows;
  } else if (statistics.has_converged && AllAgree(window)) {
    Dispel(window.EndNs());
  }
}

unsigned DoubtWatch::WhyUnheld(const Window& window, const WindowStatistics& statistics,
                               const Vector6d& density) const {
  const unsigned unheld =
      statistics.flags & (kFlagNoPoints | kFlagReverted | kFlagDegenerate | kFlagJump);
  // At the right place behind a pause, a window settles.
  const bool is_behind_pause =
      statistics.IsRestless() && IsBehindPause(window) && MayHaveMoved(window.EndNs(), density);
  return unheld | (is_behind_pause ? kFlagGap : 0U);
}

void DoubtWatch::Doubt(unsigned unheld, const Window& window, const Vector6d& density) {
  if (flags_ == 0) {
    began_ns_ = window.EndNs();
    density_ = density;
  }
  flags_ = unheld;
  causes_ |= unheld;
  if (const auto axis = CommonNormal(window.segments.back())) open_axis_world_ = axis;
  if (held_until_ns_) unseen_s_ = std::max(unseen_s_, Seconds(window.EndNs() - *held_until_ns_));
}

std::optional<StepSize> DoubtWatch::Reach(double agreement) const {
  if (flags_ == 0 || !(is_held_ || IsContradicted(agreement))) return std::nullopt;
  return StepSize{3.0 * UnseenSigma(density_[0], unseen_s_),
                  3.0 * UnseenSigma(density_[3], unseen_s_)};
}

void DoubtWatch::Dispel(std::int64_t t_ns) {
  held_until_ns_ = t_ns;
  flags_ = 0;
  causes_ = 0;
  unseen_s_ = 0.0;
  open_axis_world_.reset();
}

bool DoubtWatch::MayHaveMoved(std::int64_t t_ns, const Vector6d& density) const {
  if (!held_until_ns_) return true;  // Nobody knows how fast.
  return trajlo::MayHaveMoved(density, Seconds(t_ns - *held_until_ns_), kMoved_m, kMoved_rad);
}

double DoubtWatch::UsualAgreement() const { return usual_agreement_.value_or(kAgreementAtFirst); }

bool DoubtWatch::IsContradicted(double agreement) const {
  return agreement < kNoContradiction * UsualAgreement();
}

bool DoubtWatch::MayEnterMap(const Window& window, const Segment& segment) const {
  // A body that was never trusted has little of a map that could be spoilt.
  if (causes_ == 0 || !usual_agreement_) return true;
  // One that slid along a direction which its points left open, or jumped, sees what is new to the
  // map. But what the map has must not be contradicted.
  const bool has_slid = (causes_ & ~(kFlagDegenerate | kFlagJump)) == 0;
  return has_slid ? Agrees(window, segment, 0.0, kNoContradiction)
                  : Agrees(window, segment, kToExtendMap, kAsUsual);
}

bool DoubtWatch::Agrees(const Window& window, const Segment& segment, double on_map,
                        double of_usual) const {
  const MapAgreement agreement = AgreementOf(window, segment);
  return agreement.on_map >= on_map && agreement.worst >= of_usual * UsualAgreement();
}

bool DoubtWatch::AllAgree(const Window& window) const {
  return std::all_of(window.segments.begin(), window.segments.end(), [&](const Segment& segment) {
    return Agrees(window, segment, kToTrust, kAsUsual);
  });
}

}  // namespace trajlo
