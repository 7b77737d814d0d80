// SPDX-License-Identifier: MIT
#include "core/io/scan_folder.h"

#include <cmath>
#include <exception>
#include <utility>

#include "core/io/errors.h"
#include "core/io/format_text.h"
#include "core/io/point_file.h"
#include "core/io/scan_decoder.h"
#include "core/io/scan_numbers.h"
#include "core/io/stamp_text.h"
#include "core/io/time_probe.h"
#include "core/scans/nanoseconds.h"
#include "core/scans/scan_times.h"

namespace trajlo {
namespace {

std::string Milliseconds(std::int64_t ns) {
  return FormatText("%.6g ms", 1e-6 * static_cast<double>(ns));
}

}  // namespace

ScanFolder::ScanFolder(const std::filesystem::path& path, const ScanFolderOptions& options)
    : options_(options), listing_(ListScans(path)) {
  stamps_ = FindStamps(options_.stamps_file, &listing_);
  recorded_ns_ = FindRecordTimes(listing_);
  report_.scans_listed = listing_.files.size();
  if (!options_.remark.empty()) report_.warnings.push_back(path.string() + ": " + options_.remark);
  report_.scans_left_out = listing_.left_out;
  Warn(listing_.warnings);
  Warn(stamps_.warnings);
  const std::string doubt = DoubtOfStampUnit(TypicalPeriod(stamps_.t_ns));
  if (!doubt.empty()) Warn({stamps_.source + ": " + doubt});
  Probe();
  if (stamps_.t_ns.empty() && !convention_.IsAbsolute()) SetRegularStamps();
  if (!has_assumed_stamps_ && options_.scan_period_s != ScanFolderOptions().scan_period_s) {
    throw InputError(listing_.folder,
                     "input.scan_period_s is given, but the scans have stamps: " +
                         (stamps_.t_ns.empty() ? "the times of their points" : stamps_.source),
                     "Leave input.scan_period_s out.");
  }
  Describe(path);
  if (options_.read_ahead) StartNext({});
}

void ScanFolder::Warn(const std::vector<std::string>& warnings) {
  report_.warnings.insert(report_.warnings.end(), warnings.begin(), warnings.end());
}

/// Decides the time convention from the first scans that tell something.
void ScanFolder::Probe() {
  TimeProbe probe(listing_.folder, options_.time);
  std::string first_problem;
  for (std::size_t i = 0; i < listing_.files.size() && !probe.IsComplete(); ++i) {
    const std::filesystem::path& file = listing_.files[i];
    const auto of_scan = [&](const std::vector<std::int64_t>& times_ns) {
      return times_ns.empty() ? std::nullopt : std::optional<std::int64_t>(times_ns[i]);
    };
    PointTable table;
    try {
      table = ReadPointFile(file);
    } catch (const InputError& error) {
      if (first_problem.empty()) first_problem = error.what();
      continue;
    }
    const bool is_cloud = probe.Note(file, table, of_scan(stamps_.t_ns), of_scan(recorded_ns_));
    if (!is_cloud && first_problem.empty()) {
      first_problem = file.string() + ": a scan needs the fields x, y and z, but this file has: " +
                      table.FieldNames();
    }
  }
  if (probe.readable() == 0) {
    throw InputError(listing_.folder,
                     "no scan of " + std::to_string(listing_.files.size()) +
                         " can be read; the first says: " + first_problem,
                     "");
  }
  probe.set_period_s(TypicalPeriod(stamps_.t_ns));
  convention_ = probe.Decide();
  if (!convention_.doubt.empty()) {
    report_.warnings.push_back(listing_.folder.string() + ": " + convention_.doubt);
  }
}

void ScanFolder::SetRegularStamps() {
  has_assumed_stamps_ = true;
  // A sweep that differs clearly from the configured period knows better.
  const double sweep_s = Seconds(convention_.sweep_ns);
  double period_s = options_.scan_period_s;
  if (convention_.HasPointTimes() && std::abs(sweep_s - period_s) > 0.2 * period_s) {
    period_s = sweep_s;
  }
  const MissingScans missing = FindMissingScans(listing_.files);
  stamps_.t_ns.resize(listing_.files.size());
  for (std::size_t i = 0; i < stamps_.t_ns.size(); ++i) {
    stamps_.t_ns[i] = Nanoseconds(period_s * static_cast<double>(i + missing.before[i]));
  }
  stamps_.source =
      "none found, so a scan every " + Milliseconds(Nanoseconds(period_s)) + " from 0 s is assumed";
  const std::string folder = listing_.folder.string() + ": ";
  // Who gave the period knows it.
  if (options_.scan_period_s == ScanFolderOptions().scan_period_s) {
    Warn({folder + "stamps: " + stamps_.source + " (input.stamps_file, input.scan_period_s)"});
  }
  if (missing.finding.empty()) return;
  stamps_.warnings.push_back(folder + missing.finding);
  Warn(stamps_.warnings);
}

void ScanFolder::Describe(const std::filesystem::path& path) {
  description_ = path.string() + ": lidar " + std::to_string(options_.lidar_id) + " is " +
                 CountOf(listing_.files.size(), "scan") + " (" + listing_.extension + ") in " +
                 listing_.folder.string() + "\n";
  const bool by_points = stamps_.t_ns.empty();
  description_ += "stamps: " + (by_points ? "the earliest point of each scan" : stamps_.source);
  if (!by_points) {
    description_ += "; the first is " + FormatSeconds(stamps_.t_ns.front()) + " s, the last " +
                    FormatSeconds(stamps_.t_ns.back()) + " s";
  }
  description_ += "\npoint times: " + convention_.evidence;
  if (!recorded_ns_.empty()) description_ += "\norder among LiDARs: record_times.txt";
  for (const std::string& note : listing_.notes) description_ += "\nnote: " + note;
}

ScanFolder::Outcome ScanFolder::Decode(std::size_t index, LidarScan reused) const {
  Outcome outcome;
  outcome.index = index;
  outcome.scan = std::move(reused);
  const std::filesystem::path& file = listing_.files[index];
  try {
    const PointTable table = ReadPointFile(file);
    outcome.damage = table.damage.empty() ? "" : file.string() + ": " + table.damage;
    if (convention_.HasPointTimes() && FindTimeColumn(table, convention_.field) == nullptr) {
      outcome.damage = file.string() + ": has no field '" + convention_.field +
                       "', all its points get the stamp";
    }
    const auto stamp_ns =
        stamps_.t_ns.empty() ? std::nullopt : std::optional<std::int64_t>(stamps_.t_ns[index]);
    outcome.points_undeclared = table.undeclared;
    outcome.points_without_time = DecodeScan(file, table, convention_, stamp_ns, &outcome.scan);
    ShiftTimes(options_.clock_offset_ns, &outcome.scan);
    outcome.scan.lidar_id = options_.lidar_id;
    outcome.scan.recorded_ns = std::nullopt;
    if (!recorded_ns_.empty()) outcome.scan.recorded_ns = recorded_ns_[index];
    outcome.readable = true;
  } catch (const std::exception& error) {
    outcome.damage = error.what();
  }
  return outcome;
}

void ScanFolder::StartNext(LidarScan reused) {
  if (next_ >= listing_.files.size()) return;
  const auto policy = options_.read_ahead ? std::launch::async : std::launch::deferred;
  ahead_ = std::async(policy, &ScanFolder::Decode, this, next_++, std::move(reused));
}

std::optional<std::int64_t> ScanFolder::recorded_ns() const {
  if (recorded_ns_.empty()) return {};
  return recorded_ns_[last_];
}

void ScanFolder::CountPoints(const Outcome& outcome, std::size_t points) {
  if (outcome.points_undeclared > 0 && report_.points_undeclared == 0) {
    Warn({listing_.files[outcome.index].string() + ": the header declares " +
          CountOf(points, "point") + ", and " + std::to_string(outcome.points_undeclared) +
          " more follow: only those declared are read"});
  }
  report_.points_read += points;
  report_.points_without_time += outcome.points_without_time;
  report_.points_undeclared += outcome.points_undeclared;
}

bool ScanFolder::Next(LidarScan* scan) {
  if (!ahead_.valid()) StartNext({});
  while (ahead_.valid()) {
    Outcome outcome = ahead_.get();
    if (!outcome.damage.empty()) report_.warnings.push_back(outcome.damage);
    if (!outcome.readable) {
      ++report_.scans_skipped;
      StartNext(std::move(outcome.scan));
      continue;
    }
    std::swap(*scan, outcome.scan);
    last_ = outcome.index;
    ++report_.scans_read;
    report_.scans_damaged += outcome.damage.empty() ? 0 : 1;
    CountPoints(outcome, scan->points.size());
    if (options_.read_ahead) StartNext(std::move(outcome.scan));
    return true;
  }
  return false;
}

}  // namespace trajlo
