// SPDX-License-Identifier: MIT
#include "core/io/scan_stamps.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/io/errors.h"
#include "core/io/file_bytes.h"
#include "core/io/format_text.h"
#include "core/io/meaningful_lines.h"
#include "core/io/number_text.h"
#include "core/io/stamp_of_name.h"
#include "core/io/stamp_text.h"
#include "core/scans/median.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStampFiles[] = {"timestamps.txt", "times.txt", "stamps.txt",
                                       "timestamp.txt"};
constexpr const char* kRecordTimesFiles[] = {"record_times.txt"};

ScanStamps StampsOfNames(ScanListing* listing) {
  std::vector<std::pair<std::int64_t, fs::path>> stamped;
  for (const fs::path& file : listing->files) {
    const auto stamp = StampOfName(file);
    if (!stamp) return {};
    stamped.emplace_back(*stamp, file);
  }
  // "9.5" comes before "10.25" in time, whatever the order of the names.
  std::sort(stamped.begin(), stamped.end());
  ScanStamps stamps;
  stamps.source = "the file names";
  for (std::size_t i = 0; i < stamped.size(); ++i) {
    stamps.t_ns.push_back(stamped[i].first);
    listing->files[i] = stamped[i].second;
  }
  return stamps;
}

std::optional<std::size_t> IndexOfName(const fs::path& file) {
  return ParseWhole(file.stem().string());
}

/// A name with its numbers left out: "scan_007 (2)" -> "scan_# (#)".
std::string Pattern(const fs::path& file) {
  std::string pattern;
  for (const char c : file.stem().string()) {
    const bool is_digit = c >= '0' && c <= '9';
    if (!is_digit || pattern.empty() || pattern.back() != '#') pattern += is_digit ? '#' : c;
  }
  return pattern;
}

/// Lines go to scans in the order of their names, and that says nothing where names follow several
/// patterns: "copy of 000012.pcd" comes behind all others. Throws InputError then.
void RequireOnePattern(const ScanListing& listing, const fs::path& stamps_file) {
  std::map<std::string, std::vector<fs::path>> by_pattern;
  for (const fs::path& file : listing.files) by_pattern[Pattern(file)].push_back(file.filename());
  if (by_pattern.size() < 2) return;
  const auto rarer = [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); };
  const auto [odd, usual] = std::minmax_element(by_pattern.begin(), by_pattern.end(), rarer);
  throw InputError(stamps_file,
                   "it is not known which stamp is whose: the names of the scans do not follow one "
                   "pattern, such as " +
                       odd->second.front().string() + " and " + usual->second.front().string() +
                       " in " + listing.folder.string(),
                   "Name the scans alike, so that their order is that of the stamps, or take the "
                   "others out.");
}

/// The line of each scan when there are more stamps than scans: KITTI's raw recordings keep the
/// stamps of scans that are missing, and their names say which.
std::vector<std::size_t> LinesOfScans(const ScanListing& listing, std::size_t stamp_count) {
  std::vector<std::size_t> lines;
  for (const fs::path& file : listing.files) {
    const auto index = IndexOfName(file);
    if (!index || *index >= stamp_count) break;
    lines.push_back(*index);
  }
  if (lines.size() != listing.files.size()) {
    lines.resize(listing.files.size());
    std::iota(lines.begin(), lines.end(), std::size_t{0});
  }
  return lines;
}

/// How much more time than a period lies between scans i and i + 1, in the median over what three
/// scans on either side say: one of the stamps may be wrong.
double TimeLeftOut_s(const std::vector<std::int64_t>& t_ns, std::size_t i, double period_s) {
  std::vector<double> left_out_s;
  for (std::size_t a = 0; a < 3 && a <= i; ++a) {
    for (std::size_t b = 0; b < 3 && i + 1 + b < t_ns.size(); ++b) {
      const double step_s = Seconds(t_ns[i + 1 + b] - t_ns[i - a]);
      left_out_s.push_back(step_s - static_cast<double>(1 + a + b) * period_s);
    }
  }
  return UpperMedian(std::move(left_out_s));
}

/// Where the numbers in the names leave some out, scans are missing, and the stamps must leave out
/// their time. Where they do not, a scan has another name than it had, such as 000012.pcd become
/// 999000012.pcd, and all scans behind it have the stamps of others. Throws InputError then.
void RequireTheSameGaps(const ScanListing& listing, const std::vector<std::int64_t>& t_ns,
                        const fs::path& stamps_file) {
  constexpr std::size_t kMostMissing = 10;  // Not where a name is a time of day.
  std::vector<std::size_t> steps;
  std::size_t before = 0;
  for (std::size_t i = 0; i < listing.files.size(); ++i) {
    const auto index = IndexOfName(listing.files[i]);
    if (!index) return;
    if (i > 0) steps.push_back(*index - before);
    before = *index;
  }
  if (steps.empty()) return;
  const std::size_t usual = std::max<std::size_t>(LowerMedian(steps), 1);
  const double period_s = TypicalPeriod(t_ns);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const std::size_t missing = steps[i] / usual - 1;
    const bool leaves_out = steps[i] % usual == 0 && missing >= 1 && missing <= kMostMissing;
    if (!leaves_out || std::abs(TimeLeftOut_s(t_ns, i, period_s)) > 0.5 * period_s) continue;
    throw InputError(stamps_file,
                     "it is not known which stamp is whose: between " +
                         listing.files[i].filename().string() + " and " +
                         listing.files[i + 1].filename().string() + " in " +
                         listing.folder.string() + " a scan is missing, but no time is",
                     "Give every scan the name that it had, or number them without a gap if each "
                     "line of the stamps is that of the next file.");
  }
}

template <typename Names>
fs::path FindBeside(const fs::path& folder, const Names& names) {
  std::error_code ignored;
  const fs::path absolute = fs::absolute(folder, ignored).lexically_normal();
  // A trailing slash would make the folder its own parent.
  const fs::path clean = absolute.has_filename() ? absolute : absolute.parent_path();
  for (const fs::path& place : {clean, clean.parent_path()}) {
    for (const char* name : names) {
      if (fs::is_regular_file(place / name, ignored)) return place / name;
    }
  }
  return {};
}

/// Throws InputError if there are fewer than scans.
std::vector<std::int64_t> ReadLinesFor(const ScanListing& listing, const fs::path& file) {
  std::vector<std::int64_t> lines = ReadStampsFile(file);
  if (lines.size() >= listing.files.size()) return lines;
  throw InputError(file,
                   "has " + CountOf(lines.size(), "stamp") + ", and " +
                       CountOf(listing.files.size(), "scan was", "scans were") + " found in " +
                       listing.folder.string(),
                   "Complete the stamps file, or take out the scans that it does not cover.");
}

void WarnIfNotIncreasing(ScanStamps* stamps) {
  std::size_t backward = 0;
  std::size_t first = 0;
  for (std::size_t i = 1; i < stamps->t_ns.size(); ++i) {
    if (stamps->t_ns[i] > stamps->t_ns[i - 1]) continue;
    if (backward++ == 0) first = i;
  }
  if (backward == 0) return;
  stamps->warnings.push_back(stamps->source + ": " + CountOf(backward, "stamp is", "stamps are") +
                             " not later than the one before; the first is that of scan " +
                             std::to_string(first) + ", " + FormatSeconds(stamps->t_ns[first]) +
                             " after " + FormatSeconds(stamps->t_ns[first - 1]));
}

}  // namespace

std::vector<std::int64_t> ReadStampsFile(const fs::path& path) {
  const FileBytes bytes = ReadFileBytes(path);
  MeaningfulLines lines(bytes.view());
  std::vector<std::int64_t> stamps;
  for (std::string_view line; lines.Next(&line);) {
    const std::string_view stamp = line.substr(0, line.find_last_not_of(" \t\r") + 1);
    const std::int64_t unit_ns =
        AllDigits(stamp) ? UnitOfWholeStampNs(stamp).value_or(0) : kNsPerSecond;
    auto t_ns = unit_ns > 0 ? ParseDecimalNs(stamp, unit_ns) : std::nullopt;
    if (!t_ns) t_ns = ParseDateTimeNs(stamp);
    if (!t_ns) {
      throw InputError(path,
                       "line " + std::to_string(lines.number()) + " is not a stamp: '" +
                           std::string(stamp.substr(0, 60)) + "'",
                       "Write one stamp a line: seconds, nanoseconds, or "
                       "YYYY-MM-DD hh:mm:ss.nnnnnnnnn.");
    }
    stamps.push_back(*t_ns);
  }
  return stamps;
}

ScanStamps FindStamps(const fs::path& stamps_file, ScanListing* listing) {
  const fs::path file =
      stamps_file.empty() ? FindBeside(listing->folder, kStampFiles) : stamps_file;
  if (file.empty()) return StampsOfNames(listing);

  const std::vector<std::int64_t> lines = ReadLinesFor(*listing, file);
  RequireOnePattern(*listing, file);
  const std::size_t scans = listing->files.size();
  ScanStamps stamps;
  stamps.source = file.filename().string();
  const std::vector<std::size_t> of_scans = LinesOfScans(*listing, lines.size());
  for (const std::size_t line : of_scans) stamps.t_ns.push_back(lines[line]);
  RequireTheSameGaps(*listing, stamps.t_ns, file);
  if (lines.size() > scans) {
    const bool are_first = of_scans.back() + 1 == scans;
    stamps.warnings.push_back(stamps.source + " has " + CountOf(lines.size(), "stamp") + ", and " +
                              CountOf(scans, "scan was", "scans were") + " found; " +
                              (are_first ? "the first stamps are taken"
                                         : "the numbers in the names tell which is whose") +
                              ", so the last scan, " + listing->files.back().filename().string() +
                              ", has " + FormatSeconds(stamps.t_ns.back()) + " s");
  }
  WarnIfNotIncreasing(&stamps);
  return stamps;
}

std::vector<std::int64_t> FindRecordTimes(const ScanListing& listing) {
  const fs::path file = FindBeside(listing.folder, kRecordTimesFiles);
  if (file.empty()) return {};
  const std::vector<std::int64_t> lines = ReadLinesFor(listing, file);
  std::vector<std::int64_t> recorded_ns;
  for (const std::size_t line : LinesOfScans(listing, lines.size())) {
    recorded_ns.push_back(lines[line]);
  }
  return recorded_ns;
}

double TypicalPeriod(const std::vector<std::int64_t>& t_ns) {
  std::vector<std::int64_t> steps;
  for (std::size_t i = 1; i < t_ns.size(); ++i) {
    if (t_ns[i] > t_ns[i - 1]) steps.push_back(t_ns[i] - t_ns[i - 1]);
  }
  return Seconds(LowerMedian(std::move(steps)));
}

std::string DoubtOfStampUnit(double period_s) {
  constexpr double kRare_s = 20.0;  // In ms, a sweep of 0.02 s.
  if (period_s < kRare_s) return "";
  return FormatText("stamps are %.6g s apart: they may be in %s", period_s,
                    period_s < 1000.0 * kRare_s ? "ms" : "us") +
         ", and must then be written in s";
}

}  // namespace trajlo
