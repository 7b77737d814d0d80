// SPDX-License-Identifier: MIT
// The one list of all options. Their names, bounds and meanings stand with the structs.
#include <algorithm>
#include <utility>

#include "core/config/option.h"
#include "core/config/option_binder.h"

namespace trajlo {
namespace {

const std::string kExpertPrefix = "expert.";

}  // namespace

std::vector<Option> BindOptions(RunConfig* config) {
  OptionBinder d;
  config->input.Describe(d.In("input"));
  config->odometry.DescribeAll(d);
  // The forms of the Ceres solver stand behind its own options.
  OptionBinder forms;
  config->ceres_form.Describe(forms.In("solver.ceres"));
  const auto last_of_solver = std::find_if(
      d.options.rbegin(), d.options.rend(),
      [](const Option& option) { return option.key.find("solver.") != std::string::npos; });
  d.options.insert(last_of_solver.base(), forms.options.begin(), forms.options.end());
  std::stable_partition(d.options.begin(), d.options.end(), [](const Option& option) {
    return option.key.rfind(kExpertPrefix, 0) != 0;
  });
  return std::move(d.options);
}

std::string SectionDoc(const std::string& section) {
  static const std::vector<std::pair<std::string, std::string>> docs = {
      {"expert",
       "For those who study the estimator. The defaults are the findings of the experiments."},
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
  };
  const std::string name =
      section.rfind(kExpertPrefix, 0) == 0 ? section.substr(kExpertPrefix.size()) : section;
  for (const auto& [documented, doc] : docs) {
    if (documented == name) return doc;
  }
  return "";
}

}  // namespace trajlo
