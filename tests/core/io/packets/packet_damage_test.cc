// SPDX-License-Identifier: MIT
// Broken captures: read as far as they go, with a report, and never a crash.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/io/errors.h"
#include "tests/core/io/packets/packet_testing.h"

namespace trajlo {
namespace {

using ::testing::HasSubstr;

/// A sensor that turns.
std::string VelodyneCapture(int packets) {
  PcapText capture;
  for (int i = 0; i < packets; ++i) {
    capture.AddUdp(static_cast<std::int64_t>(i * kPacketUs), 2368, TurningVlp16(i).Bytes());
  }
  return capture.bytes();
}

/// What must hold of whatever is read; the number of points, or nothing if the file is refused.
std::optional<std::size_t> ReadAnyhow(const std::filesystem::path& file) {
  try {
    const Sweeps all = ReadSweeps(file);
    for (const CloudMessage& sweep : all.sweeps) {
      EXPECT_TRUE(sweep.stamp_ns.has_value());
      const std::vector<SweepPoint> points = Points(sweep.table);
      EXPECT_TRUE(std::all_of(points.begin(), points.end(), [](const SweepPoint& point) {
        return std::isfinite(point.x + point.y + point.z) && point.t < 2'100'000'000U;
      }));
    }
    return all.points();
  } catch (const InputError&) {
    return {};
  }
}

TEST(PacketDamage, ACutCaptureIsReadUpToTheCut) {
  const TempFolder folder;
  const std::string whole = VelodyneCapture(6);
  constexpr std::size_t kRecord = 16 + 42 + 1206;
  const auto file = folder.path() / "cut.pcap";
  for (std::size_t size = 24; size < whole.size(); size += 7) {
    std::ofstream(file, std::ios::binary) << whole.substr(0, size);
    const std::size_t packets = (size - 24) / kRecord;
    const std::size_t lost = (size - 24) % kRecord;
    if (packets == 0) {
      EXPECT_FALSE(ReadAnyhow(file)) << size;
      continue;
    }
    const Sweeps all = ReadSweeps(file);
    ASSERT_EQ(all.points(), packets * 384) << size;
    EXPECT_EQ(all.report.damaged, lost > 0) << size;
    EXPECT_EQ(all.report.bytes_lost, lost) << size;
  }
}

TEST(PacketDamage, CutPayloadsAreReadUpToTheCut) {
  const TempFolder folder;
  std::string bytes;
  for (int i = 0; i < 3; ++i) bytes += TurningVlp16(i).Bytes();
  const Sweeps all = ReadSweeps(folder.Write("cut.bin", bytes.substr(0, 3000)));
  EXPECT_EQ(all.points(), 2U * 384U);
  EXPECT_EQ(all.report.bytes_lost, 588U);
  EXPECT_THAT(all.Warnings(), HasSubstr("ends inside a packet at byte 2412 of 3000"));
}

TEST(PacketDamage, PacketsThatWereCapturedInPartAreCounted) {
  const TempFolder folder;
  const std::string good = VelodyneCapture(1);
  const std::string frame = good.substr(24 + 16);
  PcapText capture;
  capture.AddFrame(0, frame, frame.size());
  for (const std::size_t captured : {0U, 10U, 20U, 40U, 41U, 42U, 96U, 1247U}) {
    capture.AddFrame(1000, frame, captured);
  }
  const Sweeps all = ReadSweeps(folder.Write("snap.pcap", capture.bytes()));
  EXPECT_EQ(all.points(), 384U);
  EXPECT_TRUE(all.report.damaged);
  EXPECT_THAT(all.Warnings(), HasSubstr("5 packets were captured in part only"))
      << "the first three are too short to tell";
}

TEST(PacketDamage, MissingFragmentsAreCounted) {
  const TempFolder folder;
  const std::string whole = testing::ReadFile(Fixture("link_fragments.pcap"));
  // Four records; the third is left out, and a whole packet is put before them.
  std::string bytes = testing::ReadFile(Fixture("link_ethernet.pcap"));
  std::size_t at = 24;
  for (int i = 0; at < whole.size(); ++i) {
    std::uint32_t size = 0;
    std::memcpy(&size, whole.data() + at + 8, sizeof size);
    if (i != 2) bytes += whole.substr(at, 16 + size);
    at += 16 + size;
  }
  const Sweeps all = ReadSweeps(folder.Write("lost.pcap", bytes));
  EXPECT_TRUE(all.report.damaged);
  EXPECT_THAT(all.Warnings(), HasSubstr("1 packet lacks IP fragments"));
}

TEST(PacketDamage, PacketsThatContradictThemselvesAreLeftOut) {
  const TempFolder folder;
  std::string bytes;
  for (int i = 0; i < 4; ++i) bytes += TurningVlp16(i).Bytes();
  bytes[1206 * 1 + 500] = 'x';                                      // A block's flag.
  SetLittle(&bytes, 1206 * 2 + 302, Little<std::uint16_t>(20000));  // An azimuth.
  SetLittle(&bytes, 1206 * 3 + 1200, Little<std::uint32_t>(~0U));   // The time.
  const Sweeps all = ReadSweeps(folder.Write("broken.bin", bytes));
  EXPECT_EQ(all.points(), 384U);
  EXPECT_TRUE(all.report.damaged);
  EXPECT_THAT(all.Warnings(), HasSubstr("contradict themselves"));
}

TEST(PacketDamage, WhatIsNoCaptureIsRefusedWithWhatWasFound) {
  const TempFolder folder;
  const auto refused = [](const std::filesystem::path& path) -> std::string {
    try {
      const PacketCloudReader reader(path);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(refused(folder.path() / "none.pcap"), HasSubstr("none.pcap"));
  EXPECT_THAT(refused(folder.path()), HasSubstr("not a regular file"));
  EXPECT_THAT(refused(folder.Write("empty.pcap", "")),
              HasSubstr("libpcap cannot read this as a packet capture"));
  EXPECT_THAT(refused(folder.Write("text.pcap", std::string(500, 'a'))),
              HasSubstr("libpcap cannot read this as a packet capture"));
  EXPECT_THAT(refused(folder.Write("bare.pcap", PcapText().bytes())), HasSubstr("among 0 frames"));
  const std::string foreign = PcapText().AddUdp(0, 53, "a question").bytes();
  EXPECT_THAT(refused(folder.Write("dns.pcap", foreign)), HasSubstr("udp:53: 1 datagrams"));
  std::string wifi = foreign;
  wifi[20] = 105;
  EXPECT_THAT(refused(folder.Write("wifi.pcap", wifi)), HasSubstr("IEEE802_11"));
}

class FlippedCapture : public ::testing::TestWithParam<const char*> {};

TEST_P(FlippedCapture, NeverCrashesTheReader) {
  const TempFolder folder;
  const std::string name = GetParam();
  std::string whole;
  if (name == "many") {
    whole = VelodyneCapture(30);
  } else {
    whole = testing::ReadFile(Fixture(name));
    const auto metadata = std::filesystem::path(Fixture(name)).replace_extension(".json");
    if (std::filesystem::exists(metadata))
      folder.Write("flipped.json", testing::ReadFile(metadata));
  }
  const auto file = folder.path() / "flipped.pcap";
  std::mt19937 random(20240608);
  for (int round = 0; round < 600; ++round) {
    std::string bytes = whole;
    const std::size_t flips = 1 + random() % 4;
    for (std::size_t i = 0; i < flips; ++i) {
      // Half of them hit the headers, where they hurt most.
      const std::size_t reach =
          random() % 2 == 0 ? bytes.size() : std::min<std::size_t>(120, bytes.size());
      bytes[random() % reach] = static_cast<char>(random());
    }
    if (random() % 8 == 0) bytes.resize(random() % (bytes.size() + 1));
    std::ofstream(file, std::ios::binary) << bytes;
    const std::optional<std::size_t> points = ReadAnyhow(file);
    if (points) {
      ASSERT_LE(*points, whole.size());
    }
  }
}

TEST_P(FlippedCapture, NeverCrashesTheReaderThroughItsMetadata) {
  const TempFolder folder;
  const auto metadata = std::filesystem::path(Fixture(GetParam())).replace_extension(".json");
  if (!std::filesystem::exists(metadata)) return;
  const auto capture = folder.Write("run.pcap", testing::ReadFile(Fixture(GetParam())));
  const std::string whole = testing::ReadFile(metadata);
  std::mt19937 random(20240609);
  for (int round = 0; round < 600; ++round) {
    std::string bytes = whole;
    for (std::size_t i = 0; i <= random() % 4; ++i) {
      char& byte = bytes[random() % bytes.size()];
      const bool digit = byte >= '0' && byte <= '9';
      byte = static_cast<char>(digit ? '0' + random() % 10 : random() % 128);
    }
    folder.Write("run.json", bytes);
    try {
      ReadSweeps(capture);
    } catch (const InputError&) {
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Captures, FlippedCapture,
                         ::testing::Values("many", "link_fragments.pcap", "link_fragments6.pcap",
                                           "link_pcapng.pcap", "link_double_vlan.pcap",
                                           "link_sll2.pcap", "velodyne_vlp16_dual.bin",
                                           "velodyne_vlp32c_single.bin", "ouster_legacy.pcap",
                                           "ouster_rng19_rfl8_sig16_nir16_dual.pcap",
                                           "ouster_fusa_rng15_rfl8_nir8_dual.pcap"),
                         [](const auto& param) {
                           std::string name = param.param;
                           for (char& c : name) c = c == '.' ? '_' : c;
                           return name;
                         });

}  // namespace
}  // namespace trajlo
