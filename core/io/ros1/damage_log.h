// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/io/format_text.h"
#include "core/io/messages/raw_message.h"

namespace trajlo::ros1 {

/// What could not be read of a bag, put into sentences.
class DamageLog {
 public:
  explicit DamageLog(const std::filesystem::path& path) : path_(path) {}

  void Add(std::uint64_t offset, const std::string& what, std::uint64_t bytes_lost) {
    report_.damaged = true;
    report_.bytes_lost += bytes_lost;
    // A disk that fails everywhere must not fill the screen.
    constexpr std::size_t kMaxWarnings = 20;
    if (report_.warnings.size() > kMaxWarnings) return;
    report_.warnings.push_back(report_.warnings.size() == kMaxWarnings
                                   ? path_.string() +
                                         ": there is more damage, which is only counted"
                                   : path_.string() + ": at byte " + std::to_string(offset) + ": " +
                                         what + "; " + CountOf(bytes_lost, "byte") + " lost");
  }
  /// A sentence on the file as a whole; it goes in front.
  void AddSummary(const std::string& sentence) {
    report_.damaged = true;
    report_.warnings.insert(report_.warnings.begin(), path_.string() + ": " + sentence);
  }
  const MessageReport& report() const { return report_; }

 private:
  std::filesystem::path path_;
  MessageReport report_;
};

}  // namespace trajlo::ros1
