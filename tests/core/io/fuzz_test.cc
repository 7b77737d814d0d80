// SPDX-License-Identifier: MIT
// Flipped bytes in every kind of file: the reader may refuse it or read nonsense, but it must
// neither crash nor hang nor take more memory than the file justifies.
#include <random>

#include "core/io/errors.h"
#include "core/io/point_file.h"
#include "core/io/scan_decoder.h"
#include "tests/core/io/io_testing.h"

namespace trajlo {
namespace {

constexpr int kRounds = 3000;

class FlippedFile : public ::testing::TestWithParam<const char*> {};

TEST_P(FlippedFile, NeverCrashesTheReader) {
  const TempFolder folder;
  const std::string whole = testing::ReadFile(Fixture(GetParam()));
  const auto file =
      folder.path() / ("flipped" + std::filesystem::path(GetParam()).extension().string());
  std::mt19937 random(20240607);
  // Half of the flips hit the header, where they hurt most.
  std::uniform_int_distribution<std::size_t> anywhere(0, whole.size() - 1);
  std::uniform_int_distribution<std::size_t> header(0,
                                                    std::min<std::size_t>(whole.size(), 250) - 1);
  for (int round = 0; round < kRounds; ++round) {
    std::string bytes = whole;
    const int flips = 1 + static_cast<int>(random() % 4);
    for (int i = 0; i < flips; ++i) {
      const std::size_t at = random() % 2 == 0 ? anywhere(random) : header(random);
      const bool digit = bytes[at] >= '0' && bytes[at] <= '9';
      bytes[at] = digit ? static_cast<char>('0' + random() % 10) : static_cast<char>(random());
    }
    if (random() % 8 == 0) bytes.resize(random() % (bytes.size() + 1));
    std::ofstream(file, std::ios::binary) << bytes;
    try {
      const PointTable table = ReadPointFile(file);
      ASSERT_LE(table.count, whole.size());
      for (const TimeUnit unit : {TimeUnit::kSeconds, TimeUnit::kNanoseconds}) {
        TimeConvention convention;
        if (const Column* time = FindTimeColumn(table, "")) {
          convention.field = time->name;
          SampleTimes(table, *time);
        }
        convention.unit = unit;
        convention.sweep_ns = 100'000'000;
        convention.origin = random() % 2 == 0 ? TimeOrigin::kAbsolute : TimeOrigin::kSweepEnd;
        LidarScan scan;
        const bool stamped = random() % 2 == 0;
        DecodeScan(file, table, convention,
                   stamped ? std::optional<std::int64_t>(1'600'000'000'000'000'000) : std::nullopt,
                   &scan);
        ASSERT_EQ(scan.points.size(), table.count);
        for (const LidarPoint& point : scan.points) {
          // Far stamps would make a consumer bridge years with empty segments.
          ASSERT_LE(std::abs(static_cast<double>(point.t_ns - scan.stamp_ns)), 2.1e9);
        }
      }
    } catch (const InputError&) {
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Fixtures, FlippedFile,
                         ::testing::Values("pypcd4_ascii.pcd", "pypcd4_binary.pcd",
                                           "pypcd4_compressed.pcd", "pypcd4_ouster_compressed.pcd",
                                           "pypcd4_absolute_binary.pcd", "numpy_padded.pcd",
                                           "plyfile_ascii.ply", "plyfile_little.ply",
                                           "plyfile_big.ply", "plyfile_lists_ascii.ply",
                                           "plyfile_lists_little.ply", "struct_lists_big.ply",
                                           "numpy_kitti.bin"),
                         [](const auto& param) {
                           std::string name = param.param;
                           for (char& c : name) c = c == '.' ? '_' : c;
                           return name;
                         });

}  // namespace
}  // namespace trajlo
