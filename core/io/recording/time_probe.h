// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/io/messages/cloud_message.h"
#include "core/io/time_convention.h"

namespace trajlo {

/// What the first messages of one topic tell about the times of its points.
class TimeProbe {
 public:
  /// `path` is for messages.
  TimeProbe(std::filesystem::path path, TimeOptions options);

  /// Ignores a message without positions. Throws InputError if the time field that the options name
  /// is missing.
  void Note(const CloudMessage& message);
  /// True when more messages would not be asked.
  bool IsComplete() const;
  /// Messages that had positions.
  std::size_t readable() const { return readable_; }
  /// False if no header's stamp is filled, as drivers without a clock leave them; the time of
  /// recording then stands for the stamp.
  bool HasStamps() const;
  /// Throws InputError when the evidence allows no decision.
  TimeConvention Decide() const;

 private:
  std::filesystem::path path_;
  TimeOptions options_;
  TimeEvidence evidence_;
  std::vector<std::int64_t> stamps_ns_, recorded_ns_;
  std::string fields_;
  std::size_t readable_ = 0;
};

/// Reads until each of the probes, one for each of `topics`, is complete, but not for ever: a LiDAR
/// that says nothing for long is decided without evidence.
void ProbeTimes(const std::vector<std::size_t>& topics, CloudMessageReader* reader,
                std::vector<TimeProbe>* probes);

}  // namespace trajlo
