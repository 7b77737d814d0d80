// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "core/io/messages/wire_reader.h"
#include "core/io/ros1/ros1_bag_reader.h"
#include "tests/support/temp_folder.h"

namespace trajlo::testing {

/// Little-endian numbers and strings one after the other: as MCAP has them, or as CDR.
class WireText {
 public:
  explicit WireText(bool cdr) : cdr_(cdr), bytes_(cdr ? std::string("\0\1\0\0", 4) : "") {}

  template <typename T>
  WireText& Put(T value) {
    while (cdr_ && bytes_.size() % sizeof(T) != 4 % sizeof(T)) bytes_ += '\0';
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(T));
    return *this;
  }
  WireText& PutBlock(std::string_view block) {
    Put(static_cast<std::uint32_t>(block.size()));
    bytes_ += block;
    return *this;
  }
  WireText& PutString(std::string_view text) {
    return PutBlock(cdr_ ? std::string(text) + '\0' : std::string(text));
  }
  WireText& PutBytes(std::string_view bytes) {
    bytes_ += bytes;
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  bool cdr_;
  std::string bytes_;
};

/// A PointCloud2 of ROS 1 as ROS 2 serialises it.
inline std::string CloudAsCdr(std::string_view ros1) {
  WireReader from(ros1, Encoding::kRos1);
  WireText to(true);
  from.Read<std::uint32_t>();         // The header's seq.
  to.Put(from.Read<std::int32_t>());  // Its stamp.
  to.Put(from.Read<std::uint32_t>());
  to.PutString(from.ReadString());     // frame_id
  to.Put(from.Read<std::uint32_t>());  // height
  to.Put(from.Read<std::uint32_t>());  // width
  const auto fields = from.Read<std::uint32_t>();
  to.Put(fields);
  for (std::uint32_t i = 0; i < fields; ++i) {
    to.PutString(from.ReadString());
    to.Put(from.Read<std::uint32_t>());  // offset
    to.Put(from.Read<std::uint8_t>());   // datatype
    to.Put(from.Read<std::uint32_t>());  // count
  }
  to.Put(from.Read<std::uint8_t>());   // is_bigendian
  to.Put(from.Read<std::uint32_t>());  // point_step
  to.Put(from.Read<std::uint32_t>());  // row_step
  to.PutBlock(from.ReadString());      // data
  to.Put(from.Read<std::uint8_t>());   // is_dense
  EXPECT_TRUE(from.ok());
  return to.bytes();
}

/// Calls visit(topic's number, its name, recorded_ns, bytes as CDR) for the clouds of a bag.
template <typename Visit>
void ForEachCloud(const std::filesystem::path& ros1_bag, const Visit& visit) {
  Ros1BagReader reader(ros1_bag);
  RawMessage message;
  while (reader.Next(&message)) {
    const Topic& topic = reader.topics()[message.topic];
    if (topic.type != "sensor_msgs/PointCloud2") continue;
    visit(message.topic + 1, topic.name, message.recorded_ns, CloudAsCdr(message.bytes.view()));
  }
}

/// The clouds of a ROS 1 bag as rosbag2's SQLite storage has them.
inline void CopyToDb3(const std::filesystem::path& ros1_bag, const std::filesystem::path& db3) {
  sqlite3* base = nullptr;
  ASSERT_EQ(sqlite3_open(db3.c_str(), &base), SQLITE_OK);
  const auto run = [&](const std::string& sql, const std::string& blob = {}) {
    sqlite3_stmt* statement = nullptr;
    ASSERT_EQ(sqlite3_prepare_v2(base, sql.c_str(), -1, &statement, nullptr), SQLITE_OK) << sql;
    if (!blob.empty()) {
      sqlite3_bind_blob(statement, 1, blob.data(), static_cast<int>(blob.size()), SQLITE_STATIC);
    }
    ASSERT_EQ(sqlite3_step(statement), SQLITE_DONE) << sql;
    sqlite3_finalize(statement);
  };
  run("PRAGMA synchronous = OFF");
  run("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
      "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL)");
  run("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, "
      "timestamp INTEGER NOT NULL, data BLOB NOT NULL)");
  run("BEGIN");
  ForEachCloud(ros1_bag, [&](std::size_t id, const std::string& topic, std::int64_t recorded_ns,
                             const std::string& cdr) {
    run("INSERT OR IGNORE INTO topics VALUES(" + std::to_string(id) + ", '" + topic +
        "', 'sensor_msgs/msg/PointCloud2', 'cdr', '')");
    run("INSERT INTO messages(topic_id, timestamp, data) VALUES(" + std::to_string(id) + ", " +
            std::to_string(recorded_ns) + ", ?1)",
        cdr);
  });
  run("COMMIT");
  sqlite3_close(base);
}

/// The same as MCAP without chunks and without a summary.
inline void CopyToMcap(const std::filesystem::path& ros1_bag, const std::filesystem::path& mcap) {
  const std::string magic("\x89MCAP0\r\n", 8);
  std::string file = magic;
  const auto add = [&](std::uint8_t opcode, const WireText& content) {
    file += WireText(false).Put(opcode).Put(std::uint64_t{content.bytes().size()}).bytes();
    file += content.bytes();
  };
  add(0x01, WireText(false).PutString("ros2").PutString(""));
  std::map<std::size_t, std::uint32_t> written;
  ForEachCloud(ros1_bag, [&](std::size_t number, const std::string& topic, std::int64_t recorded_ns,
                             const std::string& cdr) {
    const auto id = static_cast<std::uint16_t>(number);
    const std::uint32_t sequence = written[number]++;
    if (sequence == 0) {
      add(0x03, WireText(false)
                    .Put(id)
                    .PutString("sensor_msgs/msg/PointCloud2")
                    .PutString("ros2msg")
                    .PutString(""));
      add(0x04, WireText(false).Put(id).Put(id).PutString(topic).PutString("cdr").PutString(""));
    }
    const auto time_ns = static_cast<std::uint64_t>(recorded_ns);
    add(0x05, WireText(false).Put(id).Put(sequence).Put(time_ns).Put(time_ns).PutBytes(cdr));
  });
  add(0x0f, WireText(false).Put(std::uint32_t{0}));
  add(0x02, WireText(false).Put(std::uint64_t{0}).Put(std::uint64_t{0}).Put(std::uint32_t{0}));
  WriteFile(mcap, file + magic);
}

}  // namespace trajlo::testing
