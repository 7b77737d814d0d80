// SPDX-License-Identifier: MIT
#include "core/io/scan_numbers.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/io/format_text.h"
#include "core/io/number_text.h"
#include "core/scans/median.h"

namespace trajlo {
namespace {

constexpr std::size_t kMostMissing = 600;
constexpr char kDigits[] = "0123456789";

struct NumberedName {
  std::string around;
  std::size_t number = 0;
};

/// Nothing if there is no number, or more than one.
std::optional<NumberedName> Split(const std::filesystem::path& file) {
  const std::string stem = file.stem().string();
  const std::size_t begin = stem.find_first_of(kDigits);
  const std::size_t last = stem.find_last_of(kDigits);
  if (begin == std::string::npos) return {};
  const auto number = ParseWhole(stem.substr(begin, last + 1 - begin));
  if (!number) return {};
  return NumberedName{stem.substr(0, begin) + "#" + stem.substr(last + 1), *number};
}

/// The steps from one number to the next; empty if the names do not follow one pattern, or the
/// numbers do not increase.
std::vector<std::size_t> StepsOf(const std::vector<std::filesystem::path>& files) {
  std::vector<std::size_t> steps;
  std::optional<NumberedName> before;
  for (const std::filesystem::path& file : files) {
    const auto name = Split(file);
    if (!name) return {};
    if (before && (name->around != before->around || name->number <= before->number)) return {};
    if (before) steps.push_back(name->number - before->number);
    before = name;
  }
  return steps;
}

std::string Between(const std::vector<std::filesystem::path>& files, std::size_t i) {
  return files[i].filename().string() + " and " + files[i + 1].filename().string();
}

}  // namespace

MissingScans FindMissingScans(const std::vector<std::filesystem::path>& files) {
  MissingScans missing;
  missing.before.assign(files.size(), 0);
  const std::vector<std::size_t> steps = StepsOf(files);
  if (steps.empty()) return missing;
  const std::size_t usual = LowerMedian(steps);
  // Numbers that do not go on in even steps are no count of scans, but a time, say.
  if (std::any_of(steps.begin(), steps.end(), [&](std::size_t s) { return s % usual != 0; })) {
    return missing;
  }
  std::size_t gaps = 0;
  std::string first, jump;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const std::size_t here = steps[i] / usual - 1;
    const bool is_gap = here > 0 && here <= kMostMissing;
    if (here > kMostMissing && jump.empty()) jump = Between(files, i);
    if (is_gap && gaps++ == 0) first = Between(files, i);
    missing.before[i + 1] = missing.before[i] + (is_gap ? here : 0);
  }
  if (gaps > 0) {
    missing.finding = "by the numbers in the names, " +
                      CountOf(missing.before.back(), "scan is", "scans are") + " missing, " +
                      (gaps > 1 ? "the first " : "") + "between " + first +
                      "; that much time is left out";
  }
  if (!jump.empty()) {
    missing.finding += (gaps > 0 ? "; " : "") + ("the number leaps between " + jump) +
                       ", where no time is left out";
  }
  return missing;
}

}  // namespace trajlo
