// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <cmath>

#include "core/io/errors.h"
#include "core/io/packets/velodyne_clock.h"
#include "tests/core/io/packets/packet_testing.h"

namespace trajlo {
namespace {

using ::testing::HasSubstr;

constexpr std::int64_t kSecondNs = 1'000'000'000;
/// 2020-09-13 12:00:00 UTC.
constexpr std::int64_t kNoonS = 1'599'998'400;

std::string Payloads(int count, int start_cdeg = 0) {
  std::string bytes;
  for (int i = 0; i < count; ++i) bytes += TurningVlp16(i, start_cdeg).Bytes();
  return bytes;
}

std::string PositionPacket(const std::string& sentence) {
  unsigned sum = 0;
  for (const char c : sentence) sum ^= static_cast<unsigned char>(c);
  char checksum[8];
  std::snprintf(checksum, sizeof checksum, "*%02X\r\n", sum);
  std::string bytes(512, '\0');
  const std::string text = "$" + sentence + checksum;
  return bytes.replace(206, text.size(), text);
}

TEST(VelodyneSweeps, AreCutWhereTheAzimuthPassesTheCutAngle) {
  const TempFolder folder;
  const auto file = folder.Write("turn.bin", Payloads(225));  // Three turns of 75 packets.
  for (const double cut_deg : {0.0, 90.0, 180.0, 301.3}) {
    PacketOptions options;
    options.velodyne_cut_deg = cut_deg;
    const Sweeps all = ReadSweeps(file, options);
    ASSERT_EQ(all.sweeps.size(), cut_deg == 0.0 ? 3U : 4U) << cut_deg;
    EXPECT_EQ(all.topics[0].messages, all.sweeps.size());
    EXPECT_EQ(all.topics[0].name, "velodyne");
    EXPECT_EQ(all.points(), 225U * 384U);
    const CloudMessage& second = all.sweeps[1];
    EXPECT_EQ(second.table.count, 75U * 384U) << cut_deg;
    EXPECT_EQ(second.frame_id, "velodyne");
    const SweepPoint first = Points(second.table).front();
    const double azimuth_deg = std::atan2(-first.y, first.x) * 180.0 / M_PI;
    EXPECT_NEAR(std::remainder(azimuth_deg - cut_deg, 360.0), 0.1, 0.1001) << cut_deg;
  }
}

TEST(VelodyneSweeps, HaveTimesFromTheirStampOn) {
  const TempFolder folder;
  const Sweeps all = ReadSweeps(folder.Write("turn.bin", Payloads(150)));
  ASSERT_EQ(all.sweeps.size(), 2U);
  for (const CloudMessage& sweep : all.sweeps) {
    const std::vector<SweepPoint> points = Points(sweep.table);
    EXPECT_EQ(points.front().t, 0U);
    EXPECT_NEAR(points.back().t, 75 * 1e3 * kPacketUs - 2 * 9216 - 2304, 2000);
    for (std::size_t i = 1; i < points.size(); ++i) ASSERT_GE(points[i].t + 1000, points[i - 1].t);
  }
  EXPECT_NEAR(*all.sweeps[1].stamp_ns, 75 * 1e3 * kPacketUs, 1000);
}

TEST(VelodyneSweeps, PlaceTheFiringWhereTheSensorLookedThen) {
  const TempFolder folder;
  const std::vector<SweepPoint> points =
      Points(ReadSweeps(folder.Write("one.bin", Payloads(1, 4500))).sweeps[0].table);
  // Laser 1 looks up by 1 degree, 2.304 us after the first; its ring is the ninth from below.
  const double range_m = 10.0;
  const double up_rad = M_PI / 180.0;
  for (const bool second_firing : {false, true}) {
    const SweepPoint& point = points[second_firing ? 17 : 1];
    const double after_us = 2.304 + (second_firing ? 55.296 : 0.0);
    const double azimuth_rad = (45.0 + 0.4 * after_us / 110.592) * M_PI / 180.0;
    EXPECT_NEAR(point.x, range_m * std::cos(up_rad) * std::cos(azimuth_rad), 1e-5);
    EXPECT_NEAR(point.y, -range_m * std::cos(up_rad) * std::sin(azimuth_rad), 1e-5);
    EXPECT_NEAR(point.z, range_m * std::sin(up_rad) - 0.0007, 1e-5);
    EXPECT_EQ(point.ring, 8U);
    EXPECT_EQ(point.intensity, 16.0F);
    EXPECT_EQ(point.t, second_firing ? 57600U : 2304U);
  }
}

TEST(VelodyneSweeps, LeaveOutWhatDidNotReturnAndGoOnWithoutAnyReturn) {
  const TempFolder folder;
  std::string bytes;
  for (int i = 0; i < 150; ++i) {
    VelodyneText packet = TurningVlp16(i);
    if (i >= 75) packet.distance = 0;
    bytes += packet.Bytes();
  }
  const Sweeps all = ReadSweeps(folder.Write("sky.bin", bytes));
  ASSERT_EQ(all.sweeps.size(), 2U);
  EXPECT_EQ(all.sweeps[0].table.count, 75U * 384U);
  EXPECT_EQ(all.sweeps[1].table.count, 0U);
  EXPECT_NEAR(*all.sweeps[1].stamp_ns, 75 * 1e3 * kPacketUs, 1000);
}

TEST(VelodyneSweeps, OfDualReturnsKeepBothOrTheStrongest) {
  const TempFolder folder;
  VelodyneText packet;
  packet.return_mode = 0x39;
  std::string bytes = packet.Bytes();
  // The strongest return of the first three lasers is nearer; the third has no last one.
  for (const int laser : {0, 1, 2}) {
    SetLittle(&bytes, 104 + 3 * laser, Little<std::uint16_t>(1000));
  }
  SetLittle(&bytes, 4 + 6, Little<std::uint16_t>(0));
  const auto file = folder.Write("dual.bin", bytes);
  const std::vector<SweepPoint> both = Points(ReadSweeps(file).sweeps[0].table);
  EXPECT_EQ(both.size(), 6U * 32U + 2U) << "one point where the two returns are the same";
  PacketOptions options;
  options.second_returns = false;
  const std::vector<SweepPoint> strongest = Points(ReadSweeps(file, options).sweeps[0].table);
  EXPECT_EQ(strongest.size(), 6U * 32U);
  EXPECT_NEAR(std::hypot(strongest[0].x, strongest[0].y), 2.0 * std::cos(M_PI / 12.0), 1e-4);
  EXPECT_EQ(strongest.back().t, 5U * 110592U + 55296U + 15U * 2304U);
}

TEST(VelodyneSweeps, GetTheHourOfTheCapture) {
  const TempFolder folder;
  // The sensor's clock is 20 s behind: it still counts the hour before noon.
  PcapText capture;
  for (int i = 0; i < 60; ++i) {
    capture.AddUdp(1'000'000 * kNoonS + 5'000'000 + i, 2368,
                   TurningVlp16(i, 0, 3'584'960'000U).Bytes());
  }
  const Sweeps all = ReadSweeps(folder.Write("hour.pcap", capture.bytes()));
  EXPECT_EQ(*all.sweeps[0].stamp_ns, (kNoonS - 3600 + 3584) * kSecondNs + 960'000'000);
  EXPECT_THAT(all.topics[0].remark, HasSubstr("the hour is that of the capture"));
}

TEST(VelodyneSweeps, GoOnWhenTheHourEnds) {
  const TempFolder folder;
  std::string payloads;
  PcapText capture;
  for (int i = 0; i < 150; ++i) {
    VelodyneText packet = TurningVlp16(i, 0, 3'599'900'000U);
    packet.time_us %= 3'600'000'000U;
    payloads += packet.Bytes();
    capture.AddUdp(1'000'000 * kNoonS - 100'000 + static_cast<std::int64_t>(i * kPacketUs), 2368,
                   packet.Bytes());
  }
  PacketOptions options;
  options.start_ns = (kNoonS - 60) * kSecondNs;
  for (const Sweeps& all : {ReadSweeps(folder.Write("wrap.pcap", capture.bytes())),
                            ReadSweeps(folder.Write("wrap.bin", payloads), options)}) {
    ASSERT_EQ(all.sweeps.size(), 2U);
    EXPECT_EQ(*all.sweeps[0].stamp_ns, kNoonS * kSecondNs - 100'000'000);
    EXPECT_NEAR(static_cast<double>(*all.sweeps[1].stamp_ns - *all.sweeps[0].stamp_ns),
                75 * 1e3 * kPacketUs, 2000);
    EXPECT_EQ(all.points(), 150U * 384U);
  }
}

TEST(VelodyneSweeps, GetTheHourOfTheGpsWhereItHasAFix) {
  const TempFolder folder;
  const std::string fix = "GPRMC,115959.00,A,3649.7,N,00224.4,W,0.0,212.5,130920,0.0,E,A";
  const std::string no_fix = "GPRMC,115959.00,V,3649.7,N,00224.4,W,0.0,212.5,130920,0.0,E,A";
  // The recording computer's clock is days behind.
  const std::int64_t captured_us = 1'000'000 * (kNoonS - 400'000);
  for (const bool has_fix : {true, false}) {
    PcapText capture;
    for (int i = 0; i < 60; ++i) {
      capture.AddUdp(captured_us + 1000 * i, 2368, TurningVlp16(i, 0, 3'599'000'000U).Bytes());
    }
    capture.AddUdp(captured_us + 60'000, 8308, PositionPacket(has_fix ? fix : no_fix));
    const Sweeps all = ReadSweeps(folder.Write("gps.pcap", capture.bytes()));
    EXPECT_EQ(*all.sweeps[0].stamp_ns % (3600 * kSecondNs), 3599 * kSecondNs);
    if (has_fix) {
      EXPECT_EQ(*all.sweeps[0].stamp_ns, (kNoonS - 1) * kSecondNs);
    } else {
      EXPECT_LE(std::abs(*all.sweeps[0].stamp_ns - 1000 * captured_us), 1800 * kSecondNs);
    }
    EXPECT_TRUE(all.report.warnings.empty()) << all.Warnings();
  }
}

TEST(VelodyneSweeps, DoNotTrustABrokenGpsSentence) {
  std::string packet =
      PositionPacket("GPRMC,115959.00,A,3649.7,N,00224.4,W,0.0,212.5,130920,0.0,E,A");
  const auto time_ns = [&packet] {
    return GprmcTimeNs(reinterpret_cast<const std::uint8_t*>(packet.data()), packet.size());
  };
  EXPECT_EQ(time_ns(), (kNoonS - 1) * kSecondNs);
  packet[206 + 8] = '2';
  EXPECT_FALSE(time_ns()) << "the checksum does not hold";
  packet = PositionPacket("GPRMC,115959.00,A");
  EXPECT_FALSE(time_ns()) << "no date";
  packet = PositionPacket("GPRMC,1x5959.00,A,3649.7,N,00224.4,W,0.0,212.5,130920,0.0,E,A");
  EXPECT_FALSE(time_ns()) << "no time";
}

TEST(VelodyneSweeps, CountLostRepeatedAndLatePackets) {
  const TempFolder folder;
  std::string bytes;
  for (const int i : {0, 1, 2, 2, 3, 4, 8, 9, 7, 10}) bytes += TurningVlp16(i).Bytes();
  const Sweeps all = ReadSweeps(folder.Write("lossy.bin", bytes));
  EXPECT_EQ(all.points(), 8U * 384U);
  EXPECT_THAT(all.Warnings(), HasSubstr("velodyne: 3 packets never came"));
  EXPECT_THAT(all.Warnings(), HasSubstr("velodyne: 1 packet came twice"));
  EXPECT_THAT(all.Warnings(), HasSubstr("velodyne: 1 packet came too late"));
  EXPECT_FALSE(all.report.damaged) << "the network lost them, not the file";
}

TEST(VelodyneSweeps, EndAtAGapAndWhenTheSensorDoesNotTurn) {
  const TempFolder folder;
  std::string bytes;
  for (const int i : {0, 1, 2, 40, 41}) bytes += TurningVlp16(i).Bytes();
  EXPECT_EQ(ReadSweeps(folder.Write("gap.bin", bytes)).sweeps.size(), 2U);
  bytes.clear();
  for (int i = 0; i < 2000; ++i) {
    VelodyneText packet = TurningVlp16(i);
    packet.azimuth_cdeg = 100;
    packet.step_cdeg = 0;
    bytes += packet.Bytes();
  }
  EXPECT_EQ(ReadSweeps(folder.Write("still.bin", bytes)).sweeps.size(), 3U) << "2.6 s";
}

TEST(VelodyneSweeps, AreNotCutTwiceByAnEncoderThatJittersAboutTheCutAngle) {
  const TempFolder folder;
  std::string bytes;
  for (int i = 0; i < 150; ++i) {
    bytes += TurningVlp16(i, 18000).Bytes();
  }
  const auto file = folder.Write("jitter.bin", bytes);
  EXPECT_EQ(ReadSweeps(file).sweeps.size(), 3U);
  // The block behind the cut falls back before it.
  for (std::size_t at = 0; at + 1206 <= bytes.size(); at += 100) {
    if ((at % 1206) / 100 == 12) at += 6;
    if (at + 104 > bytes.size() || bytes.substr(at + 2, 2) != std::string(2, '\0')) continue;
    SetLittle(&bytes, at + 102, Little<std::uint16_t>(35998));
  }
  EXPECT_EQ(ReadSweeps(folder.Write("jitter2.bin", bytes)).sweeps.size(), 3U);
}

TEST(VelodyneSweeps, OfTwoSensorsOnOnePortAreTwoTopics) {
  const TempFolder folder;
  PcapText capture;
  for (int i = 0; i < 75; ++i) {
    const auto us = static_cast<std::int64_t>(i * kPacketUs);
    capture.AddUdp(us, 2368, TurningVlp16(i).Bytes(), 201);
    VelodyneText other = TurningVlp16(i, 9000);
    other.product = 0x28;
    capture.AddUdp(us, 2368, other.Bytes(), 202);
  }
  const auto file = folder.Write("two.pcap", capture.bytes());
  PacketCloudReader reader(file);
  ASSERT_EQ(reader.topics().size(), 2U);
  EXPECT_EQ(reader.topics()[0].name, "velodyne:2368@192.168.1.201");
  EXPECT_EQ(reader.topics()[1].name, "velodyne:2368@192.168.1.202");
  EXPECT_EQ(reader.topics()[1].type, "VLP-32C packets");
  reader.Select({1});
  CloudMessage sweep;
  std::size_t sweeps = 0;
  for (; reader.Next(&sweep); ++sweeps) EXPECT_EQ(sweep.topic, 1U);
  EXPECT_EQ(sweeps, reader.topics()[1].messages);
}

std::string WhatReadingThrows(const std::filesystem::path& path) {
  try {
    const PacketCloudReader reader(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(VelodyneSweeps, OfOtherModelsAreRefusedByName) {
  const TempFolder folder;
  VelodyneText packet;
  packet.product = 0x00;
  std::string bytes = packet.Bytes();
  for (int block = 1; block < 12; block += 2) {
    SetLittle(&bytes, 100 * block, Little<std::uint16_t>(0xddff));
  }
  const auto hdl64e = folder.Write("64.pcap", PcapText().AddUdp(0, 2368, bytes).bytes());
  EXPECT_THAT(WhatReadingThrows(hdl64e),
              HasSubstr("HDL-64E: every unit needs its own calibration"));
  packet.product = 0xa1;
  const auto vls128 = folder.Write("128.bin", packet.Bytes());
  EXPECT_THAT(WhatReadingThrows(vls128), HasSubstr("VLS-128"));
  packet.product = 0x00;
  const auto unnamed = folder.Write("unnamed.bin", packet.Bytes());
  EXPECT_THAT(WhatReadingThrows(unnamed),
              HasSubstr("name it with input.velodyne_model: VLP-16, Puck-Hi-Res"));
  PacketOptions options;
  options.velodyne_model = VelodyneModel::kHdl32e;
  EXPECT_EQ(ReadSweeps(unnamed, options).topics[0].type, "HDL-32E packets");
}

}  // namespace
}  // namespace trajlo
