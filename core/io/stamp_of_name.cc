// SPDX-License-Identifier: MIT
#include "core/io/stamp_of_name.h"

#include <algorithm>
#include <regex>
#include <string>
#include <string_view>

#include "core/io/stamp_text.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

/// The last run of digits of a name, with one '.' or '_' between digits: "cloud_12_034" ->
/// "12_034".
std::string_view StampPart(std::string_view stem) {
  const std::size_t last = stem.find_last_of("0123456789");
  if (last == std::string_view::npos) return {};
  const std::size_t before = stem.find_last_not_of("0123456789._", last);
  std::string_view part = stem.substr(before == std::string_view::npos ? 0 : before + 1, last + 1);
  part = part.substr(0, stem.data() + last + 1 - part.data());
  part.remove_prefix(std::min(part.find_first_of("0123456789"), part.size()));
  return part;
}

/// A file name that ends in a date and a time of day with a fraction: 2020-03-10-12-30-58.500,
/// 20200310T123058.5, scan_2020-03-10_12:30:58.500.
std::optional<std::int64_t> DateTimeOfName(const std::string& stem) {
  static const std::regex form(
      R"((?:.*[^0-9])?(\d{4})-?(\d\d)-?(\d\d)[-_T ](\d\d)[-:_]?(\d\d)[-:_]?(\d\d\.\d+))");
  std::smatch part;
  if (!std::regex_match(stem, part, form)) return {};
  return ParseDateTimeNs(part.str(1) + "-" + part.str(2) + "-" + part.str(3) + " " + part.str(4) +
                         ":" + part.str(5) + ":" + part.str(6));
}

/// Whether numbers stand before the last one, of which it may be but a part: the seconds of
/// "10-12-30-58.500" begin again after a minute.
bool IsPartOfMore(std::string_view stem, std::string_view part) {
  const auto before = static_cast<std::size_t>(part.data() - stem.data());
  constexpr std::size_t kEpochDigits = 9;
  return part.find('.') < kEpochDigits && before >= 3 && AllDigits(stem.substr(before - 3, 2));
}

}  // namespace

std::optional<std::int64_t> StampOfName(const std::filesystem::path& file) {
  const std::string stem = file.stem().string();
  if (const auto date_time = DateTimeOfName(stem)) return date_time;
  const std::string_view part = StampPart(stem);
  if (IsPartOfMore(stem, part)) return {};
  if (AllDigits(part)) {
    const auto unit_ns = UnitOfWholeStampNs(part);
    return part.size() > 10 && unit_ns ? ParseDecimalNs(part, *unit_ns) : std::nullopt;
  }
  const std::size_t split = part.find_first_of("._");
  if (split == std::string_view::npos) return {};
  const std::string_view seconds = part.substr(0, split);
  const std::string_view rest = part.substr(split + 1);
  if (!AllDigits(seconds) || !AllDigits(rest)) return {};
  if (part[split] == '.') {
    return rest.size() >= 3 ? ParseDecimalNs(part, kNsPerSecond) : std::nullopt;
  }
  // ROS tools write seconds and nanoseconds as two whole numbers, often without leading zeros.
  if (seconds.size() != 10 || rest.size() > 9) return {};
  const auto whole_ns = ParseDecimalNs(seconds, kNsPerSecond);
  return whole_ns ? std::optional(*whole_ns + *ParseDecimalNs(rest, 1)) : std::nullopt;
}

}  // namespace trajlo
