// SPDX-License-Identifier: MIT
// The sample captures, of which fixtures/samples.csv holds points that other decoders computed
// (ouster-sdk, velodyne-decoder). They are not part of the repository.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>
#include <sstream>

#include "core/io/point_file.h"
#include "tests/core/io/packets/packet_testing.h"

namespace trajlo {
namespace {

struct Sample {
  const char* name;
  const char* extension;
  std::size_t datagrams;
  std::vector<std::size_t> points;
  /// Of the first sweep, in the sensor's own clock.
  std::int64_t stamp_ns;
};

void PrintTo(const Sample& sample, std::ostream* out) { *out << sample.name; }

const Sample kSamples[] = {
    {"OS-0-32-U1_v2.2.0_1024x10", ".pcap", 64, {21803}, 515816892860},
    {"OS-1-128_v2.3.0_1024x10_lb_n3", ".pcap", 192, {107647, 107357, 107532}, 991587364520},
    {"OS-1-32-G_v2.1.1_1024x10", ".pcap", 64, {27310}, 3577133606620},
    {"sample_velodyne_hdl32", ".pcap", 500, {23216, 57734, 57882, 7873}, 1319768035374684152},
    {"sample_velodyne_vlp16_gps",
     ".pcap",
     293,
     {14522, 18549, 18554, 18494, 3367},
     1453364282340624952},
    {"vlp16_static_payloads",
     ".bin",
     1000,
     {10097, 15375, 15325, 15248, 15244, 15299, 15304, 15265, 15282, 15274, 15315, 15306, 15307,
      9393},
     2666163101304}};

class SampleCapture : public ::testing::TestWithParam<Sample> {
 protected:
  void SetUp() override {
    file_ = DataDir() / "packets" / (std::string(GetParam().name) + GetParam().extension);
    if (!std::filesystem::exists(file_)) GTEST_SKIP() << "no capture at " << file_;
  }

  std::filesystem::path file_;
};

TEST_P(SampleCapture, IsReadWholeWithoutOptions) {
  const Sample& sample = GetParam();
  PacketOptions options;
  options.join_clocks = false;
  const Sweeps all = ReadSweeps(file_, options);
  EXPECT_TRUE(all.report.warnings.empty()) << all.Warnings();
  EXPECT_FALSE(all.report.damaged);
  EXPECT_EQ(all.topics[0].messages, sample.points.size());
  EXPECT_NE(all.topics[0].remark.find(std::to_string(sample.datagrams) + " datagrams"),
            std::string::npos)
      << all.topics[0].remark;
  ASSERT_EQ(all.sweeps.size(), sample.points.size());
  EXPECT_EQ(*all.sweeps[0].stamp_ns, sample.stamp_ns);
  for (std::size_t i = 0; i < all.sweeps.size(); ++i) {
    EXPECT_EQ(all.sweeps[i].table.count, sample.points[i]) << i;
    for (const SweepPoint& point : Points(all.sweeps[i].table)) {
      ASSERT_LT(point.t, 115'000'000U);
      ASSERT_LT(std::hypot(point.x, point.y, point.z), 300.0F);
    }
  }
}

/// By time, row and distance, as the decoders' points are sorted.
std::vector<SweepPoint> SortedPoints(const Sweeps& all, bool by_ring) {
  std::vector<SweepPoint> points = AllPoints(all);
  if (by_ring) {
    std::stable_sort(points.begin(), points.end(), [](const SweepPoint& a, const SweepPoint& b) {
      return std::make_pair(a.t, a.ring) < std::make_pair(b.t, b.ring);
    });
  }
  return points;
}

TEST_P(SampleCapture, HasThePointsThatOtherDecodersSee) {
  std::vector<SweepPoint> points;
  std::ifstream csv(Fixture("samples.csv"));
  std::string line;
  std::size_t compared = 0;
  while (std::getline(csv, line)) {
    if (line.compare(0, line.find(','), GetParam().name) != 0) continue;
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream text(line);
    std::string name;
    std::size_t count = 0;
    std::size_t index = 0;
    double t_ns = 0.0;
    double ring = 0.0;
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
    double intensity = 0.0;
    ASSERT_TRUE(text >> name >> count >> index >> t_ns >> ring >> x >> y >> z >> intensity) << line;
    const bool ouster = name.compare(0, 2, "OS") == 0;
    if (points.empty()) points = SortedPoints(ReadSweeps(file_), ouster);
    ASSERT_EQ(points.size(), count);
    const SweepPoint& point = points[index];
    EXPECT_NEAR(point.t, t_ns, ouster ? 500.0 : 1000.0) << line;
    EXPECT_EQ(point.ring, ring) << line;
    EXPECT_EQ(point.intensity, intensity) << line;
    // The other decoder of Velodyne packets rounds azimuths to 0.01 degrees.
    const double tolerance_m = ouster ? 1e-4 : 1e-4 + 1e-4 * std::hypot(x, y);
    EXPECT_NEAR(point.x, x, tolerance_m) << line;
    EXPECT_NEAR(point.y, y, tolerance_m) << line;
    EXPECT_NEAR(point.z, z, 1e-4) << line;
    ++compared;
  }
  if (std::string(GetParam().extension) == ".pcap") {
    EXPECT_EQ(compared, 40U);
  }
}

INSTANTIATE_TEST_SUITE_P(Captures, SampleCapture, ::testing::ValuesIn(kSamples),
                         [](const auto& param) {
                           std::string name = param.param.name;
                           for (char& c : name) c = std::isalnum(c) != 0 ? c : '_';
                           return name;
                         });

// The same payloads, decoded by their recorder into point files. It cuts at 180 degrees, leaves the
// lasers' heights out, takes the sensor's nominal speed for azimuths within a block, and does not
// write the sweep that the end of the recording cuts.
TEST(SamplePayloads, AgreeWithThePointFilesOfTheirRecorder) {
  const std::filesystem::path payloads = DataDir() / "packets" / "vlp16_static_payloads.bin";
  const std::filesystem::path scans = DataDir() / "vlp16_static";
  if (!std::filesystem::exists(payloads) || !std::filesystem::is_directory(scans)) {
    GTEST_SKIP() << "no payloads at " << payloads;
  }
  PacketOptions options;
  options.velodyne_cut_deg = 180.0;
  options.start_ns = 1'584'002'666'000'000'000;
  const Sweeps all = ReadSweeps(payloads, options);
  ASSERT_EQ(all.sweeps.size(), 15U);
  const std::vector<SweepPoint> points = AllPoints(all);
  const std::int64_t first_ns = *all.sweeps[0].stamp_ns;
  std::ifstream stamps(scans / "timestamps.txt");
  constexpr float kUpM[] = {0.0112F,  0.0097F,  0.0081F,  0.0066F,  0.0051F,  0.0037F,
                            0.0022F,  0.0007F,  -0.0007F, -0.0022F, -0.0037F, -0.0051F,
                            -0.0066F, -0.0081F, -0.0097F, -0.0112F};
  std::size_t i = 0;
  double worst_m = 0.0;
  for (int scan = 0; scan < 14; ++scan) {
    char name[32];
    std::snprintf(name, sizeof name, "%06d.pcd", scan);
    const PointTable table = ReadPointFile(scans / "scans" / name);
    const std::vector<double> x = Values(table, "x");
    const std::vector<double> y = Values(table, "y");
    const std::vector<double> z = Values(table, "z");
    const std::vector<double> time = Values(table, "time");
    const std::vector<double> intensity = Values(table, "intensity");
    std::string seconds;
    std::string fraction;
    ASSERT_TRUE(std::getline(stamps, seconds, '.') && std::getline(stamps, fraction));
    const std::int64_t stamp_ns = std::stoll(seconds) * 1'000'000'000 + std::stoll(fraction);
    for (std::size_t k = 0; k < x.size(); ++k, ++i) {
      const SweepPoint& point = points.at(i);
      ASSERT_NEAR(static_cast<double>(first_ns - stamp_ns + point.t), 1e9 * time[k], 1000.0) << i;
      ASSERT_EQ(point.intensity, intensity[k]) << i;
      ASSERT_NEAR(point.z - kUpM[point.ring], z[k], 1e-5) << i;
      worst_m = std::max(worst_m, std::hypot(point.x - x[k], point.y - y[k]));
    }
  }
  EXPECT_EQ(i, points.size() - all.sweeps.back().table.count);
  EXPECT_LT(worst_m, 0.001);
}

}  // namespace
}  // namespace trajlo
