// SPDX-License-Identifier: MIT
// The one list of all options. Their keys, bounds and meanings stand in options/, by section.
#include <utility>

#include "core/config/option.h"
#include "core/config/options/bind_options.h"
#include "core/config/options/option_binder.h"

namespace trajlo {

std::vector<Option> BindOptions(RunConfig* config) {
  OdometryOptions* odometry = &config->odometry;
  OptionBinder binder;
  BindInput(&config->input, &binder);
  BindSensing(&odometry->segmenter, &binder);
  BindMap(&odometry->map, &binder);
  BindRegistration(&odometry->registration, &binder);
  BindMotionPrior(&odometry->motion_prior, &binder);
  BindSolver(&odometry->solver, &config->ceres_form, &binder);
  BindMarginalization(&odometry->marginalization, &binder);
  BindEstimation(odometry, &binder);
  return std::move(binder.options);
}

std::string SectionDoc(const std::string& section) {
  static const std::vector<std::pair<std::string, std::string>> docs = {
      {"input",
       "How the recording is read. Times that are left to auto are decided by evidence, "
       "which is printed."},
      {"sensor", "The LiDARs."},
      {"segmenter", "How the stream of points is cut into segments and thinned."},
      {"map", "The local map that points are registered to."},
      {"map.plane", "When neighbours make a plane."},
      {"registration", "How the distance of a point to its plane is weighed."},
      {"motion_prior", "How freely the body is taken to move."},
      {"solver", "How a window is solved."},
      {"solver.ceres", "Other forms of the Ceres solver, for comparison."},
      {"marginalization", "How the past is kept when a segment leaves the window."},
      {"window", "The sliding window."},
      {"initialization", "How the first interval is treated."},
      {"lost", "When the estimator stops believing itself."},
  };
  for (const auto& [name, doc] : docs) {
    if (name == section) return doc;
  }
  return "";
}

}  // namespace trajlo
