// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "core/io/errors.h"
#include "core/io/packets/ouster_metadata.h"
#include "tests/core/io/packets/packet_testing.h"

namespace trajlo {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

constexpr int kColumns = 512;
constexpr int kColumnSize = 12 + 16 * 4;
constexpr std::int64_t kCapturedUs = 1'600'000'000'000'000;
constexpr std::int64_t kTurnNs = 100'000'000;

/// The packet of the low-bandwidth profile that the sensor's maker wrote, moved to another place.
std::string Packet(int frame_id, int packet, std::int64_t turn_ns = 0) {
  static const std::string written =
      testing::ReadFile(Fixture("ouster_rng15_rfl8_nir8.pcap")).substr(82);
  std::string bytes = written;
  SetLittle(&bytes, 2, Little(static_cast<std::uint16_t>(frame_id)));
  for (int i = 0; i < 16; ++i) {
    const int column = 16 * packet + i;
    const std::size_t at = 32 + i * kColumnSize;
    const std::int64_t t_ns = turn_ns + column * kTurnNs / kColumns;
    SetLittle(&bytes, at, Little(static_cast<std::uint64_t>(5'000'000'000 + t_ns)));
    SetLittle(&bytes, at + 8, Little(static_cast<std::uint16_t>(column)));
  }
  return bytes;
}

std::string Metadata() { return testing::ReadFile(Fixture("ouster_rng15_rfl8_nir8.json")); }

/// Frames of 32 packets.
PcapText Frames(const std::vector<int>& frame_ids) {
  PcapText capture;
  std::int64_t turn = 0;
  for (const int frame_id : frame_ids) {
    for (int i = 0; i < 32; ++i) {
      capture.AddUdp(kCapturedUs + 100'000 * turn + 3'125 * (i + 1), 7502,
                     Packet(frame_id, i, turn * kTurnNs));
    }
    ++turn;
  }
  return capture;
}

std::size_t PointsOfPacket() { return ReadSweeps(Fixture("ouster_rng15_rfl8_nir8.pcap")).points(); }

std::string WhatReadingThrows(const std::filesystem::path& path,
                              const PacketOptions& options = {}) {
  try {
    const PacketCloudReader reader(path, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(OusterSweeps, AreTheFramesEvenWhenTheirNumberWrapsOrStartsAgain) {
  const TempFolder folder;
  folder.Write("run.json", Metadata());
  const auto file = folder.Write("run.pcap", Frames({65534, 65535, 0, 1, 7, 4000, 12}).bytes());
  const Sweeps all = ReadSweeps(file);
  EXPECT_EQ(all.topics[0].messages, 7U);
  EXPECT_EQ(all.topics[0].type, "OS-1-16 packets");
  ASSERT_EQ(all.sweeps.size(), 7U);
  for (const CloudMessage& sweep : all.sweeps) {
    EXPECT_EQ(sweep.table.count, 32 * PointsOfPacket());
    EXPECT_EQ(sweep.frame_id, "os_sensor");
    const std::vector<SweepPoint> points = Points(sweep.table);
    EXPECT_EQ(points.front().t, 0U);
    EXPECT_NEAR(points.back().t, kTurnNs, 1e6);
  }
  EXPECT_TRUE(all.report.warnings.empty()) << all.Warnings();
}

TEST(OusterSweeps, OfASensorWithoutClockGetThatOfTheCapture) {
  const TempFolder folder;
  folder.Write("run.json", Metadata());
  const auto file = folder.Write("run.pcap", Frames({1, 2}).bytes());
  const Sweeps joined = ReadSweeps(file);
  EXPECT_NEAR(static_cast<double>(*joined.sweeps[0].stamp_ns), 1e3 * kCapturedUs, 1e6);
  EXPECT_THAT(joined.topics[0].remark, HasSubstr("counts from power-on"));
  PacketOptions options;
  options.join_clocks = false;
  const Sweeps own = ReadSweeps(file, options);
  EXPECT_EQ(*own.sweeps[0].stamp_ns, 5'000'000'000);
  EXPECT_EQ(*own.sweeps[1].stamp_ns - *own.sweeps[0].stamp_ns,
            *joined.sweeps[1].stamp_ns - *joined.sweeps[0].stamp_ns);
}

TEST(OusterSweeps, TellOfLostRepeatedAndLatePackets) {
  const TempFolder folder;
  folder.Write("run.json", Metadata());
  PcapText capture;
  for (const int frame : {1, 2, 3}) {
    for (int i = 0; i < 32; ++i) {
      const bool lost = frame == 2 && (i == 5 || i == 6);
      if (lost) continue;
      capture.AddUdp(kCapturedUs, 7502, Packet(frame, i, frame * kTurnNs));
      if (frame == 2 && i == 9) capture.AddUdp(kCapturedUs, 7502, Packet(2, i, frame * kTurnNs));
      if (frame == 3 && i == 1) capture.AddUdp(kCapturedUs, 7502, Packet(2, 5, 2 * kTurnNs));
    }
  }
  const Sweeps all = ReadSweeps(folder.Write("run.pcap", capture.bytes()));
  ASSERT_EQ(all.sweeps.size(), 3U);
  EXPECT_EQ(all.sweeps[1].table.count, 30 * PointsOfPacket());
  EXPECT_EQ(all.sweeps[2].table.count, 32 * PointsOfPacket());
  EXPECT_THAT(all.Warnings(), HasSubstr("ouster:7502: 32 columns of whole sweeps never came"));
  EXPECT_THAT(all.Warnings(), HasSubstr("ouster:7502: 16 columns came twice"));
  EXPECT_THAT(all.Warnings(), HasSubstr("ouster:7502: 1 packet came too late"));
  EXPECT_FALSE(all.report.damaged);
}

TEST(OusterSweeps, OfAColumnWindowAreWholeWithoutTheRest) {
  const TempFolder folder;
  json metadata = json::parse(Metadata());
  metadata["data_format"]["column_window"] = {496, 15};
  folder.Write("run.json", metadata.dump());
  PcapText capture;
  for (const int frame : {1, 2, 3}) {
    for (const int i : {31, 0}) {
      capture.AddUdp(kCapturedUs, 7502, Packet(frame, i, frame * kTurnNs));
    }
  }
  const Sweeps all = ReadSweeps(folder.Write("run.pcap", capture.bytes()));
  EXPECT_EQ(all.sweeps.size(), 3U);
  EXPECT_TRUE(all.report.warnings.empty()) << all.Warnings();
}

TEST(OusterSweeps, LeaveOutColumnsThatAreBrokenAndPacketsOfAnotherSize) {
  const TempFolder folder;
  folder.Write("run.json", Metadata());
  PcapText capture = Frames({1});
  std::string packet = Packet(2, 0, kTurnNs);
  SetLittle(&packet, 32 + 8, Little<std::uint16_t>(512));  // No such column.
  SetLittle(&packet, 32 + kColumnSize, Little<std::uint64_t>(~std::uint64_t{0}));  // No such time.
  capture.AddUdp(kCapturedUs, 7502, packet);
  capture.AddUdp(kCapturedUs, 7502, packet.substr(0, 900));
  capture.AddUdp(kCapturedUs, 9999, "something else");
  const Sweeps all = ReadSweeps(folder.Write("run.pcap", capture.bytes()));
  ASSERT_EQ(all.sweeps.size(), 2U);
  EXPECT_LT(all.sweeps[1].table.count, PointsOfPacket());
  EXPECT_TRUE(all.report.damaged);
  EXPECT_THAT(all.Warnings(), HasSubstr("2 columns have an impossible number or time"));
  EXPECT_THAT(all.Warnings(), HasSubstr("1 datagram has another size"));
  EXPECT_THAT(all.Warnings(), HasSubstr("udp:9999: 1 datagram is not a LiDAR packet"));
}

TEST(OusterSweeps, OfDualReturnsKeepBothOrTheFirst) {
  const auto file = Fixture("ouster_rng19_rfl8_sig16_nir16_dual.pcap");
  PacketOptions options;
  options.second_returns = false;
  const std::size_t both = ReadSweeps(file).points();
  const std::size_t first = ReadSweeps(file, options).points();
  EXPECT_LT(first, both);
  EXPECT_GT(first, both / 3);
}

TEST(OusterMetadata, IsFoundBesideTheCaptureByItsName) {
  const TempFolder folder;
  const auto capture = folder.Write("drive_3_part.pcap", Frames({1}).bytes());
  EXPECT_THAT(WhatReadingThrows(capture), HasSubstr("drive_3_part.json was looked for"));
  const auto only = folder.Write("sensor.json", Metadata());
  EXPECT_THAT(FindOusterMetadata(capture), ::testing::ElementsAre(only));
  const auto drive = folder.Write("drive.json", Metadata());
  EXPECT_THAT(FindOusterMetadata(capture), ::testing::ElementsAre(drive));
  const auto drive3 = folder.Write("drive_3.json", Metadata());
  EXPECT_THAT(FindOusterMetadata(capture), ::testing::ElementsAre(drive3));
  const auto left = folder.Write("drive_3_part_left.json", Metadata());
  const auto own = folder.Write("drive_3_part.json", Metadata());
  EXPECT_THAT(FindOusterMetadata(capture), ::testing::ElementsAre(own, left));
  EXPECT_EQ(ReadSweeps(capture).sweeps.size(), 1U);
}

TEST(OusterMetadata, OfSeveralSensorsIsToldApartBySerialNumber) {
  const TempFolder folder;
  json other = json::parse(Metadata());
  other["prod_sn"] = "42";
  other["prod_line"] = "OS-2-16";
  folder.Write("run_a.json", other.dump());
  folder.Write("run_b.json", Metadata());
  PcapText capture = Frames({1});
  std::string packet = Packet(1, 0);
  SetLittle(&packet, 7, std::string("\x2a\0\0\0\0", 5));
  capture.AddUdp(kCapturedUs, 7502, packet, 202);
  const Sweeps all = ReadSweeps(folder.Write("run.pcap", capture.bytes()));
  ASSERT_EQ(all.topics.size(), 2U);
  EXPECT_EQ(all.topics[0].type, "OS-1-16 packets");
  EXPECT_EQ(all.topics[1].name, "ouster:7502@192.168.1.202");
  EXPECT_EQ(all.topics[1].type, "OS-2-16 packets");
  EXPECT_TRUE(all.report.warnings.empty()) << all.Warnings();
}

TEST(OusterMetadata, OfAnotherSensorIsRefused) {
  const TempFolder folder;
  json other = json::parse(Metadata());
  other["prod_sn"] = "42";
  folder.Write("run.json", other.dump());
  EXPECT_THAT(WhatReadingThrows(folder.Write("run.pcap", Frames({1}).bytes())),
              HasSubstr("run.json is of the sensor 42"));
}

TEST(OusterMetadata, ThatCannotBeUsedIsAnErrorThatNamesTheEntry) {
  const TempFolder folder;
  const auto capture = folder.Write("run.pcap", Frames({1}).bytes());
  const auto refused = [&](const std::string& pointer, const json& value) {
    json metadata = json::parse(Metadata());
    metadata[json::json_pointer(pointer)] = value;
    PacketOptions options;
    options.ouster_metadata = {folder.Write("other/given.json", metadata.dump())};
    return WhatReadingThrows(capture, options);
  };
  EXPECT_EQ(refused("/hostname", "os.local"), "");
  EXPECT_THAT(refused("/data_format/udp_profile_lidar", "RNG7"), HasSubstr("profile RNG7 is not"));
  EXPECT_THAT(refused("/beam_altitude_angles", json()), HasSubstr("beam_altitude_angles is miss"));
  EXPECT_THAT(refused("/beam_altitude_angles", {1, 2}), HasSubstr("there are 2 beam_altitude"));
  EXPECT_THAT(refused("/beam_altitude_angles/0", "up"), HasSubstr("something else than numbers"));
  EXPECT_THAT(refused("/data_format/pixels_per_column", 32), HasSubstr("32 pixels_per_column"));
  EXPECT_THAT(refused("/data_format/columns_per_frame", 0), HasSubstr("columns_per_frame is 0"));
  EXPECT_THAT(refused("/data_format/columns_per_frame", -3), HasSubstr("columns_per_frame is -3"));
  EXPECT_THAT(refused("/data_format/column_window", {0, 9999}), HasSubstr("column_window/1"));
  EXPECT_THAT(refused("/lidar_to_sensor_transform", {1, 2, 3}), HasSubstr("3 numbers instead of"));
  EXPECT_THAT(refused("/lidar_origin_to_beam_origin_mm", "far"),
              HasSubstr("_origin_mm is \"far\""));
  EXPECT_THAT(refused("/data_format/columns_per_packet", 8), HasSubstr("not of the size that"));
  folder.Write("run.json", "{ broken");
  EXPECT_THAT(WhatReadingThrows(capture), HasSubstr("run.json: this is not a JSON object"));
}

TEST(OusterMetadata, OfEarlyFirmwareHasNoFormatAndMeansTheLegacyProfile) {
  const TempFolder folder;
  json metadata = json::parse(testing::ReadFile(Fixture("ouster_legacy.json")));
  metadata.erase("data_format");
  const OusterMetadata early = ReadOusterMetadata(folder.Write("early.json", metadata.dump()));
  EXPECT_EQ(early.profile, "LEGACY");
  EXPECT_EQ(early.columns_per_frame, 512U);
  EXPECT_EQ(early.window(), 512U);
}

}  // namespace
}  // namespace trajlo
