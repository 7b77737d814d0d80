// SPDX-License-Identifier: MIT
#include "core/io/messages/livox_decoder.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "core/io/messages/message_header.h"
#include "core/io/messages/wire_reader.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

/// offset_time, x, y, z, reflectivity, tag, line.
constexpr std::size_t kPointBytes = 19;
/// CDR puts the next offset_time at a multiple of four; behind the last point nothing follows.
constexpr std::size_t kPointStepCdr = 20;
/// Drivers round the header's stamp, to microseconds at worst.
constexpr std::int64_t kRoundingNs = 1'000'000;
/// Stamps taken when the message was published are late by a sweep and the transport, not more.
constexpr std::int64_t kLongestDelayNs = 1'000'000'000;

/// The time from which offset_time counts.
std::int64_t ChooseStamp(std::int64_t stamp_ns, std::uint64_t timebase_ns, std::string* remark) {
  const auto timebase = static_cast<std::int64_t>(timebase_ns);
  if (timebase <= 0) return stamp_ns;
  if (stamp_ns == 0) return timebase;
  const std::int64_t apart_ns = stamp_ns - timebase;
  if (std::abs(apart_ns) < kRoundingNs) return timebase;
  const bool same_clock = std::abs(apart_ns) < kLongestDelayNs;
  *remark = "the header's stamp is " + std::to_string(Seconds(apart_ns)) +
            " s after the timebase; " +
            (same_clock ? "they seem to be one clock, so point times count from the timebase"
                        : "they are different clocks, so point times count from the stamp");
  return same_clock ? timebase : stamp_ns;
}

}  // namespace

bool DecodeLivox(Encoding encoding, FileBytes* bytes, CloudMessage* cloud, std::string* remark) {
  WireReader reader(bytes->view(), encoding);
  MessageHeader header = ReadMessageHeader(&reader);
  const auto timebase_ns = reader.Read<std::uint64_t>();
  reader.Read<std::uint32_t>();  // point_num: the length of the array says the same.
  reader.ReadBytes(4);           // lidar_id and three reserved bytes
  const std::size_t declared = reader.Read<std::uint32_t>();
  if (!reader.ok()) {
    *remark = "a Livox CustomMsg of " + std::to_string(bytes->size()) +
              " bytes that ends before its points begin";
    return false;
  }
  const std::size_t step = encoding == Encoding::kCdr ? kPointStepCdr : kPointBytes;
  const std::size_t there =
      reader.remaining() < kPointBytes ? 0 : (reader.remaining() - kPointBytes) / step + 1;
  PointTable table;
  table.count = std::min(declared, there);
  if (table.count < declared) {
    table.damage = std::to_string(declared) + " Livox points declared, " +
                   std::to_string(table.count) + " whole ones in " +
                   std::to_string(reader.remaining()) + " bytes";
  }
  std::size_t offset = reader.position();
  const auto add = [&](const char* name, ScalarType type) {
    table.columns.push_back({name, type, offset, step, reader.swap_bytes()});
    offset += SizeOf(type);
  };
  add("offset_time", ScalarType::kUint32);
  for (const char* axis : {"x", "y", "z"}) add(axis, ScalarType::kFloat32);
  for (const char* name : {"reflectivity", "tag", "line"}) add(name, ScalarType::kUint8);
  table.bytes = std::exchange(*bytes, {});
  cloud->stamp_ns = ChooseStamp(header.stamp_ns, timebase_ns, remark);
  cloud->frame_id = std::move(header.frame_id);
  cloud->table = std::move(table);
  return true;
}

}  // namespace trajlo
