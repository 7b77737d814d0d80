// SPDX-License-Identifier: MIT
#include "core/comparison/variant_doubt.h"

#include <map>
#include <utility>

namespace trajlo {
namespace {

constexpr char kOfCeres[] = "expert.solver.ceres.";
/// A comparison of windows has its own: one round, until the steps vanish.
constexpr const char* kOfRounds[] = {"expert.solver.max_rounds",
                                     "expert.solver.iterations_per_round",
                                     "expert.solver.step_tolerance_"};

/// The keys of the settings that begin so.
std::vector<std::string> KeysWith(const std::string& settings, const std::string& begin) {
  std::vector<std::string> keys;
  for (std::size_t at = settings.find(begin); at != std::string::npos;) {
    const std::size_t end = settings.find_first_of("=: \t", at);
    keys.push_back(settings.substr(at, end - at));
    at = settings.find(begin, at + begin.size());
  }
  return keys;
}

std::string Listed(const std::vector<std::string>& words) {
  std::string list;
  for (std::size_t i = 0; i < words.size(); ++i) {
    list += (i == 0 ? "" : i + 1 < words.size() ? ", " : " and ") + words[i];
  }
  return list;
}

std::string NoEffect(const std::vector<std::string>& keys, const std::string& where) {
  return Listed(keys) + (keys.size() == 1 ? " has" : " have") + " no effect " + where;
}

/// What is not used is at its default.
std::string EffectiveConfig(const SolverVariant& variant) {
  RunConfig config;
  config.odometry = variant.odometry;
  if (variant.odometry.solver.kind == SolverKind::kCeres) config.ceres_form = variant.ceres_form;
  return DumpConfig(config);
}

}  // namespace

std::vector<std::string> DoubtVariants(const std::vector<SolverVariant>& variants,
                                       const RunConfig& base, bool lockstep) {
  std::vector<std::string> sentences;
  std::map<std::string, std::string> first_with;
  for (const SolverVariant& variant : variants) {
    std::string text;
    if (variant.odometry.solver.kind == SolverKind::kGaussNewton) {
      const auto keys = KeysWith(variant.settings, kOfCeres);
      if (!keys.empty()) text = NoEffect(keys, "with solver.kind=gauss_newton");
    }
    const auto [first, is_new] = first_with.try_emplace(EffectiveConfig(variant), variant.name);
    if (!is_new) {
      text += (text.empty() ? "" : ", so ") + std::string("it is the same as '") + first->second +
              "', and any difference between the two is noise";
    }
    if (!text.empty()) sentences.push_back("'" + variant.name + "': " + text);
    std::vector<std::string> of_rounds;
    for (const char* begin : kOfRounds) {
      for (std::string& key : KeysWith(variant.settings, begin)) {
        of_rounds.push_back(std::move(key));
      }
    }
    if (!lockstep || of_rounds.empty() || !IsAboutOneWindow(variant, base)) continue;
    sentences.push_back("'" + variant.name + "': " +
                        NoEffect(of_rounds,
                                 "in lockstep, where a window is solved in one round until its "
                                 "steps vanish; whole runs show it"));
  }
  return sentences;
}

}  // namespace trajlo
