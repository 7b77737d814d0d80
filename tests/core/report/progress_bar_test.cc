// SPDX-License-Identifier: MIT
#include "core/report/progress_bar.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <poll.h>
#include <unistd.h>

#include <cstdlib>

namespace trajlo {
namespace {

using ::testing::HasSubstr;

constexpr Progress kHalf = {75, 150, 7.5, 2.5, 0.82};

TEST(ProgressLine, ShowsScanPercentSpeedAndInliers) {
  EXPECT_EQ(ProgressLine(kHalf, 72),
            "[=========>         ]  50 %  scan 75/150  3.0 x real time  inliers 82 %");
}

constexpr Progress kOneOfSeveral = {75, 150, 7.5, 2.5, 0.82, "gauss_newton"};

TEST(ProgressLine, NamesTheRunIfThereAreSeveral) {
  EXPECT_EQ(ProgressLine(kOneOfSeveral, 72),
            "gauss_newton  [==>  ]  50 %  scan 75/150  3.0 x real time  inliers 82 %");
}

TEST(ProgressLine, FitsAnyTerminal) {
  for (int columns = 0; columns < 200; ++columns) {
    for (const Progress& progress : {kHalf, kOneOfSeveral}) {
      EXPECT_LT(ProgressLine(progress, columns).size(), static_cast<std::size_t>(columns) + 1);
    }
  }
  EXPECT_EQ(ProgressLine(kHalf, 56).find('['), std::string::npos);
}

TEST(ProgressLine, NothingKnownAndMoreScansThanListedAreHarmless) {
  EXPECT_THAT(ProgressLine({}, 100), HasSubstr("  0 %  scan 0/0  0.0 x"));
  EXPECT_THAT(ProgressLine({5, 4, 0.0, 0.0, 0.0}, 100), HasSubstr("100 %"));
}

TEST(ReadingLine, ShowsPercentAndMessages) {
  EXPECT_EQ(ReadingLine(67, 150), "reading  45 % (67 of 150 messages)");
  EXPECT_EQ(ReadingLine(0, 0), "reading   0 % (0 of 0 messages)");
}

/// All that can be read; a terminal hands it on after a moment.
std::string ReadAll(int fd) {
  std::string text;
  char buffer[4096];
  pollfd ready = {fd, POLLIN, 0};
  while (poll(&ready, 1, 300) > 0 && (ready.revents & POLLIN) != 0) {
    const ssize_t size = read(fd, buffer, sizeof(buffer));
    if (size <= 0) break;
    text.append(buffer, static_cast<std::size_t>(size));
  }
  return text;
}

/// What the bar writes to the file descriptor `write_end`, read from `read_end`.
std::string Drawn(int read_end, int write_end, bool quiet) {
  std::FILE* stream = fdopen(write_end, "w");
  {
    ProgressBar bar(stream, quiet);
    for (int i = 0; i < 100; ++i) bar.Update(kHalf);
  }
  std::fflush(stream);
  const std::string text = ReadAll(read_end);
  std::fclose(stream);
  close(read_end);
  return text;
}

TEST(ProgressBar, IsSilentInAPipe) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  EXPECT_EQ(Drawn(ends[0], ends[1], false), "");
}

class ProgressBarOnATerminal : public ::testing::Test {
 protected:
  void SetUp() override {
    master_ = posix_openpt(O_RDWR | O_NOCTTY);
    if (master_ < 0 || grantpt(master_) != 0 || unlockpt(master_) != 0) {
      GTEST_SKIP() << "no pseudo terminal here";
    }
    terminal_ = open(ptsname(master_), O_RDWR | O_NOCTTY);
    ASSERT_GE(terminal_, 0);
  }
  int master_ = -1;
  int terminal_ = -1;
};

TEST_F(ProgressBarOnATerminal, DrawsAtMostTenTimesASecondAndClearsTheLine) {
  const std::string drawn = Drawn(master_, terminal_, false);
  EXPECT_THAT(drawn, HasSubstr("scan 75/150"));
  EXPECT_EQ(drawn.find("scan"), drawn.rfind("scan"));
  EXPECT_EQ(drawn.substr(drawn.size() - 4), "\r\x1b[K");
}

TEST_F(ProgressBarOnATerminal, IsSilentWhenAskedTo) {
  EXPECT_EQ(Drawn(master_, terminal_, true), "");
}

}  // namespace
}  // namespace trajlo
