// SPDX-License-Identifier: MIT
#include "core/report/progress_bar.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>

#include "core/io/format_text.h"

namespace trajlo {
namespace {

constexpr auto kRedraw = std::chrono::milliseconds(100);

int Columns(std::FILE* stream) {
  winsize size{};
  if (ioctl(fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  return 80;
}

/// More than are listed are harmless.
double Share(std::size_t done, std::size_t all) {
  return all > 0 ? std::min(1.0, static_cast<double>(done) / static_cast<double>(all)) : 0.0;
}

}  // namespace

std::string ProgressLine(const Progress& progress, int columns) {
  const double share = Share(progress.scan, progress.scans);
  const double speed = progress.wall_s > 0.0 ? progress.data_s / progress.wall_s : 0.0;
  const std::string of = progress.of.empty() ? "" : std::string(progress.of) + "  ";
  std::string line =
      FormatText("%3.0f %%  scan %zu/%zu  %.1f x real time  inliers %.0f %%", 100.0 * share,
                 progress.scan, progress.scans, speed, 100.0 * progress.inlier_share);
  // The bar takes what the numbers leave; the last column stays free, or the line would wrap.
  const int width = std::min(40, columns - 1 - static_cast<int>(of.size() + line.size()) - 3);
  if (width >= 5) {
    const auto filled = static_cast<std::size_t>(share * width);
    std::string bar(filled, '=');
    if (filled < static_cast<std::size_t>(width)) bar += '>';
    bar.resize(static_cast<std::size_t>(width), ' ');
    line = "[" + bar + "] " + line;
  }
  line.insert(0, of);
  return line.substr(0, static_cast<std::size_t>(std::max(columns - 1, 0)));
}

std::string ReadingLine(std::size_t done, std::size_t all) {
  return FormatText("reading %3.0f %% (%zu of %zu messages)", 100.0 * Share(done, all), done, all);
}

ProgressBar::ProgressBar(std::FILE* stream, bool quiet)
    : stream_(!quiet && isatty(fileno(stream)) != 0 ? stream : nullptr) {}

ProgressBar::~ProgressBar() {
  if (stream_ == nullptr) return;
  std::fputs("\r\x1b[K", stream_);
  std::fflush(stream_);
}

bool ProgressBar::IsDue() {
  if (stream_ == nullptr) return false;
  const auto now = std::chrono::steady_clock::now();
  if (now - drawn_ < kRedraw) return false;
  drawn_ = now;
  return true;
}

void ProgressBar::Draw(const std::string& line) {
  std::fprintf(stream_, "\r%s\x1b[K", line.c_str());
  std::fflush(stream_);
}

void ProgressBar::Update(const Progress& progress) {
  if (IsDue()) Draw(ProgressLine(progress, Columns(stream_)));
}

void ProgressBar::Update(std::size_t done, std::size_t all) {
  if (IsDue()) Draw(ReadingLine(done, all));
}

}  // namespace trajlo
