// SPDX-License-Identifier: MIT
// Packets of random measurements against the decoders of other people (see fixtures).
#include <algorithm>
#include <cmath>
#include <fstream>
#include <tuple>

#include "tests/core/io/packets/packet_testing.h"

namespace trajlo {
namespace {

/// A row of a .points file.
struct Expected {
  std::uint32_t t;
  std::uint32_t ring;
  float x, y, z, intensity;
};

std::vector<Expected> ReadExpected(const std::string& name) {
  const std::string bytes = testing::ReadFile(Fixture(name + ".points"));
  std::vector<Expected> rows(bytes.size() / sizeof(Expected));
  std::memcpy(rows.data(), bytes.data(), rows.size() * sizeof(Expected));
  return rows;
}

float Range(const SweepPoint& point) { return std::hypot(point.x, point.y, point.z); }

/// `across_rad`: how far the directions may differ.
void ExpectSame(const Sweeps& sweeps, const std::vector<Expected>& expected, double t_ns,
                double across_rad, double along_m) {
  std::vector<SweepPoint> points = AllPoints(sweeps);
  std::sort(points.begin(), points.end(), [](const SweepPoint& a, const SweepPoint& b) {
    return std::make_tuple(a.t, a.ring, Range(a)) < std::make_tuple(b.t, b.ring, Range(b));
  });
  ASSERT_EQ(points.size(), expected.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SweepPoint& point = points[i];
    const Expected& row = expected[i];
    EXPECT_NEAR(point.t, row.t, t_ns) << i;
    EXPECT_EQ(point.ring, row.ring) << i;
    EXPECT_EQ(point.intensity, row.intensity) << i;
    const double tolerance_m = across_rad * Range(point) + along_m;
    EXPECT_NEAR(point.x, row.x, tolerance_m) << i;
    EXPECT_NEAR(point.y, row.y, tolerance_m) << i;
    EXPECT_NEAR(point.z, row.z, along_m) << i;
  }
}

class OusterProfile : public ::testing::TestWithParam<const char*> {};

TEST_P(OusterProfile, GivesThePointsOfTheSensorMakersSdk) {
  const std::string name = std::string("ouster_") + GetParam();
  const Sweeps sweeps = ReadSweeps(Fixture(name + ".pcap"));
  ASSERT_EQ(sweeps.sweeps.size(), 1U);
  EXPECT_EQ(sweeps.topics[0].name, "ouster:7502");
  EXPECT_EQ(sweeps.topics[0].messages, 1U);
  EXPECT_TRUE(sweeps.report.warnings.empty()) << sweeps.Warnings();
  ExpectSame(sweeps, ReadExpected(name), 0.0, 0.0, 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Profiles, OusterProfile,
                         ::testing::Values("legacy", "rng19_rfl8_sig16_nir16",
                                           "rng19_rfl8_sig16_nir16_dual", "rng15_rfl8_nir8",
                                           "rng15_rfl8_nir8_dual", "fusa_rng15_rfl8_nir8_dual"),
                         [](const auto& param) { return std::string(param.param); });

class VelodyneKindOfPacket : public ::testing::TestWithParam<const char*> {};

// The other decoder rounds azimuths to 0.01 degrees, times to float32 seconds, and computes the
// VLP-16's heights anew, which the manual gives to 0.1 mm.
TEST_P(VelodyneKindOfPacket, GivesThePointsOfAnotherDecoder) {
  const std::string name = std::string("velodyne_") + GetParam();
  const Sweeps sweeps = ReadSweeps(Fixture(name + ".bin"));
  EXPECT_EQ(sweeps.sweeps.size(), 2U) << "the azimuth passes 0";
  ExpectSame(sweeps, ReadExpected(name), 1000.0, 1e-4, 1.2e-4);
}

INSTANTIATE_TEST_SUITE_P(Models, VelodyneKindOfPacket,
                         ::testing::Values("vlp16_single", "vlp16_dual", "puck_hi_res_single",
                                           "puck_hi_res_dual", "hdl32e_single", "hdl32e_dual",
                                           "vlp32c_single", "vlp32c_dual"),
                         [](const auto& param) { return std::string(param.param); });

class LinkLayer : public ::testing::TestWithParam<const char*> {};

TEST_P(LinkLayer, CarriesTheSamePacket) {
  const Sweeps plain = ReadSweeps(Fixture("link_ethernet.pcap"));
  ASSERT_GT(plain.points(), 50U);
  const Sweeps sweeps = ReadSweeps(Fixture(std::string("link_") + GetParam() + ".pcap"));
  EXPECT_EQ(sweeps.topics.size(), 1U);
  EXPECT_EQ(sweeps.topics[0].name, "velodyne:2368");
  EXPECT_TRUE(sweeps.report.warnings.empty()) << sweeps.Warnings();
  ASSERT_EQ(sweeps.sweeps.size(), plain.sweeps.size());
  for (std::size_t i = 0; i < plain.sweeps.size(); ++i) {
    EXPECT_EQ(sweeps.sweeps[i].table.bytes.view(), plain.sweeps[i].table.bytes.view());
    EXPECT_EQ(sweeps.sweeps[i].stamp_ns, plain.sweeps[i].stamp_ns);
    EXPECT_EQ(sweeps.sweeps[i].recorded_ns, 1'600'000'000'250'000'000);
  }
}

INSTANTIATE_TEST_SUITE_P(Links, LinkLayer,
                         ::testing::Values("ethernet", "vlan", "double_vlan", "ipv6", "ip_options",
                                           "fragments", "fragments_reversed", "fragments6", "sll",
                                           "sll2", "raw", "nanoseconds", "pcapng"),
                         [](const auto& param) { return std::string(param.param); });

}  // namespace
}  // namespace trajlo
