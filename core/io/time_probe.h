// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/io/point_table.h"
#include "core/io/time_convention.h"

namespace trajlo {

/// What the first scans of one LiDAR tell about the times of its points. Scans that have too few
/// points, or none that are finite, tell nothing: more are asked then. Of several fields with a
/// known name, the first that is not the same for all points of a scan is taken.
class TimeProbe {
 public:
  /// Not for ever: a recording of empty scans is decided without evidence.
  static constexpr std::size_t kMostScans = 500;

  /// `path` is for messages.
  TimeProbe(std::filesystem::path path, TimeOptions options);

  const std::filesystem::path& path() const { return path_; }

  /// Takes the next scan; false if it has no positions. Throws InputError, which names `where`, if
  /// the time field that the options name is missing.
  bool Note(const std::filesystem::path& where, const PointTable& table,
            std::optional<std::int64_t> stamp_ns, std::optional<std::int64_t> recorded_ns);
  /// Why the first scan without positions is one; empty if all had some.
  const std::string& problem() const { return problem_; }
  /// True when more scans would not be asked.
  bool IsComplete() const;
  /// Scans that had positions.
  std::size_t readable() const { return readable_; }
  /// False if no stamp is filled, as drivers without a clock leave them; the time of recording then
  /// stands for the stamp.
  bool HasStamps() const;
  /// Typical time between stamps, where the recording knows it better than the first scans.
  void set_period_s(double period_s) { period_s_ = period_s; }
  /// Throws InputError when the evidence allows no decision, or contradicts what the options say.
  TimeConvention Decide() const;

 private:
  /// A field that may have the times, and what it says.
  struct Candidate {
    std::filesystem::path where;
    std::string field;
    ScalarType type;
    std::vector<TimeSample> samples, poor_samples;  ///< Poor: of scans with few points.
    std::size_t constant = 0;                       ///< Scans whose points all have one time.
  };

  std::vector<const Column*> ColumnsOf(const std::filesystem::path& where,
                                       const PointTable& table) const;
  Candidate& CandidateOf(const std::filesystem::path& where, const Column& column);
  void NoteIgnored(const PointTable& table, const Column& column);
  bool StampsAreUnfilled() const;
  /// The first candidate with other than constant values; null if there is none.
  const Candidate* Chosen() const;
  std::string ConstantFields() const;
  TimeConvention DecideBy(const Candidate& candidate) const;
  /// By one that stands behind constant ones: what cannot be understood is no time, perhaps.
  TimeConvention DecideByOther(const Candidate& candidate) const;
  TimeConvention DecideWithoutTimes() const;

  std::filesystem::path path_;
  TimeOptions options_;
  double period_s_ = 0.0;
  std::vector<Candidate> candidates_;  ///< In the order in which they would be taken.
  std::vector<std::int64_t> stamps_ns_, recorded_ns_;
  std::string fields_, unknown_fields_;  ///< Of the first scan with points.
  std::string ignored_field_;            ///< Has times, which the options tell to ignore.
  std::string problem_;
  std::size_t readable_ = 0;
  std::size_t with_points_ = 0;
};

}  // namespace trajlo
