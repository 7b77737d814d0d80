// SPDX-License-Identifier: MIT
#include "apps/compare/compare_warnings.h"

#include <algorithm>
#include <utility>

namespace trajlo {
namespace {

/// "'a', 'b'", or "all runs".
std::string Listed(const std::vector<std::string>& names, std::size_t runs) {
  if (runs > 1 && names.size() == runs) return "all runs";
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "'" : ", '") + name + "'";
  return list;
}

/// Each sentence that `texts_of` has for an error once, with the runs it is about.
template <typename TextsOf>
std::vector<std::string> Grouped(const CompareReport& report, TextsOf&& texts_of) {
  std::vector<std::pair<std::string, std::vector<std::string>>> names_of;
  for (const FreeResult& run : report.free) {
    if (!run.truth_error) continue;
    for (const std::string& text : texts_of(*run.truth_error)) {
      auto found = std::find_if(names_of.begin(), names_of.end(),
                                [&](const auto& entry) { return entry.first == text; });
      if (found == names_of.end()) found = names_of.insert(found, {text, {}});
      found->second.push_back(run.name);
    }
  }
  std::vector<std::string> sentences;
  for (const auto& [text, names] : names_of) {
    sentences.push_back(Listed(names, report.free.size()) + ": " + text);
  }
  return sentences;
}

}  // namespace

std::vector<std::string> WarningsOfRuns(const CompareReport& report) {
  return Grouped(report, [](const TruthError& error) { return error.warnings; });
}

std::vector<std::string> FailuresOfRuns(const CompareReport& report) {
  return Grouped(report, [](const TruthError& error) {
    return error.failure.empty() ? std::vector<std::string>() : std::vector{error.failure};
  });
}

}  // namespace trajlo
