// SPDX-License-Identifier: MIT
#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/io/atomic_file.h"
#include "core/io/messages/bag_writer.h"

namespace trajlo {

/// Writes an SQLite file of rosbag2 (.db3), with the interfaces of its messages as ROS 2 has stored
/// them since Iron; older ROS 2 reads it, too.
class Db3Writer : public BagWriter {
 public:
  explicit Db3Writer(const std::filesystem::path& path, IfExists if_exists = IfExists::kFail);
  Db3Writer(const Db3Writer&) = delete;
  Db3Writer& operator=(const Db3Writer&) = delete;

  Encoding encoding() const override { return Encoding::kCdr; }
  /// `message` has 512 MB at most.
  void Write(const TopicDescription& topic, std::int64_t recorded_ns,
             std::string_view message) override;
  void Close() override;

 private:
  struct CloseDatabase {
    void operator()(sqlite3* database) const { sqlite3_close_v2(database); }
  };
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
  };
  using Statement = std::unique_ptr<sqlite3_stmt, Finalize>;

  void Check(int result) const;
  void Execute(const char* sql);
  Statement Prepare(const char* sql);
  void BindText(sqlite3_stmt* statement, int place, const std::string& text);
  /// Runs a statement to its end, and makes it ready to be run again.
  void Step(sqlite3_stmt* statement);
  std::int64_t IdOf(const TopicDescription& topic);

  std::filesystem::path path_;
  /// Declared before the database, which must be closed first.
  std::optional<AtomicFile> file_;
  std::unique_ptr<sqlite3, CloseDatabase> database_;
  Statement insert_message_;
  std::map<std::string, std::int64_t> ids_;  ///< By topic and type.
  std::map<std::string, bool> defined_;      ///< Types with a text in the file.
};

}  // namespace trajlo
