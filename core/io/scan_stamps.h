// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/io/scan_listing.h"

namespace trajlo {

/// The stamps of the scans, one for each file of a listing.
struct ScanStamps {
  /// Empty: neither a stamps file nor file names tell them.
  std::vector<std::int64_t> t_ns;
  /// "timestamps.txt", "the file names", ...
  std::string source;
  /// Things that look wrong, to be printed.
  std::vector<std::string> warnings;
};

/// Reads one stamp a line: seconds as decimal text (also 1.03e-01), whole numbers of s, ms, us or
/// ns by their size, or date and time. Blank lines and lines that begin with # are skipped.
/// Throws InputError with the line's number when a line is none of these.
std::vector<std::int64_t> ReadStampsFile(const std::filesystem::path& path);

/// Finds the stamps of the listed scans in `stamps_file` if that is given, else in timestamps.txt
/// or times.txt beside the scans or one level up, else in the file names (the listing is then
/// sorted by them). With more stamps than scans, names that are whole numbers pick their line.
/// Throws InputError if there are fewer stamps than scans, or if the names leave open which scan
/// comes when: they follow several patterns, or their numbers miss a scan where the stamps do not.
ScanStamps FindStamps(const std::filesystem::path& stamps_file, ScanListing* listing);

/// When each of the listed scans was recorded, which orders the scans of several LiDARs where
/// stamps are broken: from record_times.txt beside the scans or one level up, in the form of a
/// stamps file; empty without it. Throws InputError as FindStamps does.
std::vector<std::int64_t> FindRecordTimes(const ScanListing& listing);

/// The median of the steps between stamps that are positive, s; 0 if there are none.
double TypicalPeriod(const std::vector<std::int64_t>& t_ns);

/// What to think of stamps in s that are so far apart that they may be in ms or us; else empty.
std::string DoubtOfStampUnit(double period_s);

}  // namespace trajlo
