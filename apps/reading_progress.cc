// SPDX-License-Identifier: MIT
#include "apps/reading_progress.h"

#include <unistd.h>

#include <algorithm>

namespace trajlo {

ReadingProgress::ReadingProgress(std::FILE* stream, bool quiet)
    : stream_(!quiet && isatty(fileno(stream)) != 0 ? stream : nullptr) {}

ReadingProgress::~ReadingProgress() {
  if (stream_ == nullptr) return;
  std::fputs("\r\x1b[K", stream_);
  std::fflush(stream_);
}

void ReadingProgress::Update(std::size_t done, std::size_t all) {
  if (stream_ == nullptr) return;
  const auto now = std::chrono::steady_clock::now();
  if (now - drawn_ < std::chrono::milliseconds(100)) return;
  drawn_ = now;
  const double share =
      all > 0 ? std::min(1.0, static_cast<double>(done) / static_cast<double>(all)) : 0.0;
  std::fprintf(stream_, "\rreading %3.0f %% (%zu of %zu messages)\x1b[K", 100.0 * share, done, all);
  std::fflush(stream_);
}

}  // namespace trajlo
