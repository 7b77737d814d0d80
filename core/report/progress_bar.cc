// SPDX-License-Identifier: MIT
#include "core/report/progress_bar.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>

namespace trajlo {
namespace {

constexpr auto kRedraw = std::chrono::milliseconds(100);

int Columns(std::FILE* stream) {
  winsize size{};
  if (ioctl(fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  return 80;
}

}  // namespace

std::string ProgressLine(const Progress& progress, int columns) {
  const double share =
      progress.scans > 0
          ? std::min(1.0, static_cast<double>(progress.scan) / static_cast<double>(progress.scans))
          : 0.0;
  const double speed = progress.wall_s > 0.0 ? progress.data_s / progress.wall_s : 0.0;
  char numbers[160];
  std::snprintf(numbers, sizeof(numbers),
                "%3.0f %%  scan %zu/%zu  %.1f x real time  inliers %.0f %%", 100.0 * share,
                progress.scan, progress.scans, speed, 100.0 * progress.inlier_share);
  std::string line = numbers;
  // The bar takes what the numbers leave; the last column stays free, or the line would wrap.
  const int width = std::min(40, columns - 1 - static_cast<int>(line.size()) - 3);
  if (width >= 5) {
    const auto filled = static_cast<std::size_t>(share * width);
    std::string bar(filled, '=');
    if (filled < static_cast<std::size_t>(width)) bar += '>';
    bar.resize(static_cast<std::size_t>(width), ' ');
    line = "[" + bar + "] " + line;
  }
  return line.substr(0, static_cast<std::size_t>(std::max(columns - 1, 0)));
}

ProgressBar::ProgressBar(std::FILE* stream, bool quiet)
    : stream_(!quiet && isatty(fileno(stream)) != 0 ? stream : nullptr) {}

ProgressBar::~ProgressBar() {
  if (stream_ == nullptr) return;
  std::fputs("\r\x1b[K", stream_);
  std::fflush(stream_);
}

void ProgressBar::Update(const Progress& progress) {
  if (stream_ == nullptr) return;
  const auto now = std::chrono::steady_clock::now();
  if (now - drawn_ < kRedraw) return;
  drawn_ = now;
  std::fprintf(stream_, "\r%s\x1b[K", ProgressLine(progress, Columns(stream_)).c_str());
  std::fflush(stream_);
}

}  // namespace trajlo
