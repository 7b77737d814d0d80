// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <unordered_map>
#include <vector>

#include "core/io/messages/raw_message.h"
#include "core/io/ros2/sqlite_file.h"

namespace trajlo {

/// The messages of one SQLite file of rosbag2 (.db3), in the order of their recording times; memory
/// holds one message. Of a file that is cut off or broken comes what SQLite still finds: rows that
/// cannot be read are skipped and counted, and where the index of times is broken, reading goes on
/// in the order of the rows.
class Db3Reader final : public RawMessageReader {
 public:
  /// `shown` is the name for messages to the user, if it is not `path`.
  explicit Db3Reader(const std::filesystem::path& path, const std::filesystem::path& shown = {});
  Db3Reader(const Db3Reader&) = delete;
  Db3Reader& operator=(const Db3Reader&) = delete;

  const std::vector<Topic>& topics() const override { return topics_; }
  void Select(const std::vector<std::size_t>& topics) override;
  bool Next(RawMessage* message) override;
  const MessageReport& report() const override { return report_; }

 private:
  void ReadTopics();
  void ReadInterfaces();
  bool NextRow(std::int64_t* row);
  bool ReadRow(std::int64_t row, RawMessage* message);
  void ReportLostRow(std::uint64_t bytes);
  void Warn(const std::string& sentence);

  std::filesystem::path shown_;
  SqliteFile file_;
  std::unordered_map<std::int64_t, std::size_t> topic_of_id_;
  std::vector<Topic> topics_;
  std::vector<bool> selected_;
  SqliteQuery by_time_;
  SqliteQuery by_row_;
  SqliteQuery head_;
  SqliteBlobs data_;
  enum class Order { kByTime, kByRow, kEnded } order_ = Order::kByTime;
  /// A row takes a byte at least: pages that refer to each other in circles end here.
  std::uint64_t rows_left_;
  std::int64_t largest_row_;
  std::uint64_t lost_rows_ = 0;
  std::size_t lost_rows_warning_ = 0;
  MessageReport report_;
};

}  // namespace trajlo
