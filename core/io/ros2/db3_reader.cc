// SPDX-License-Identifier: MIT
#include "core/io/ros2/db3_reader.h"

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "core/io/errors.h"
#include "core/io/format_text.h"
#include "core/io/ros2/topic_names.h"
#include "core/io/ros2/unpack.h"

namespace trajlo {

Db3Reader::Db3Reader(const std::filesystem::path& path, const std::filesystem::path& shown)
    : shown_(shown.empty() ? path : shown),
      file_(path, shown_),
      // rosbag2 keeps an index of the timestamps: SQLite walks it, and only numbers are sorted in a
      // file that has none. The messages themselves never enter a sort.
      by_time_(file_, "SELECT id FROM messages ORDER BY timestamp, id"),
      by_row_(file_, "SELECT id FROM messages WHERE id > ?1 ORDER BY id"),
      head_(file_, "SELECT topic_id, timestamp FROM messages WHERE id = ?1"),
      data_(&file_, "messages", "data"),
      rows_left_(file_.size()),
      largest_row_(std::numeric_limits<std::int64_t>::min()) {
  ReadTopics();
  selected_.assign(topics_.size(), true);
  if (file_.missing_bytes() == 0) return;
  report_.bytes_lost = file_.missing_bytes();
  Warn("the file is cut off: it has " + std::to_string(file_.size()) + " bytes and misses " +
       std::to_string(file_.missing_bytes()));
}

void Db3Reader::ReadTopics() {
  SqliteQuery tables(file_,
                     "SELECT name FROM sqlite_master WHERE type = 'table' AND name IN ('messages', "
                     "'topics')");
  if (tables.Step() != SqliteQuery::Result::kRow || tables.Step() != SqliteQuery::Result::kRow) {
    throw InputError(shown_, "this database has no tables 'topics' and 'messages'",
                     "Give a file that rosbag2 recorded.");
  }
  SqliteQuery topics(file_, "SELECT id, name, type, serialization_format FROM topics ORDER BY id");
  SqliteQuery::Result result = topics.Step();
  for (; result == SqliteQuery::Result::kRow; result = topics.Step()) {
    const Topic topic = MakeTopic(topics.Text(1), topics.Text(2), topics.Text(3));
    topic_of_id_[topics.Integer(0)] = topics_.size();
    topics_.push_back(topic);
  }
  ReadInterfaces();
  if (topics_.empty()) {
    throw InputError(shown_,
                     result == SqliteQuery::Result::kError
                         ? "its table of topics cannot be read: " + file_.LastError()
                         : "its table of topics is empty",
                     "The recording was empty, or its first pages are damaged.");
  }
  SqliteQuery rows(file_, "SELECT topic_id FROM messages");
  for (std::uint64_t left = file_.size(); left > 0; --left) {
    if (rows.Step() != SqliteQuery::Result::kRow) break;
    const auto topic = topic_of_id_.find(rows.Integer(0));
    if (topic != topic_of_id_.end()) ++topics_[topic->second].messages;
  }
}

/// ROS 2 has stored them since Iron, and the qualities of service a little longer.
void Db3Reader::ReadInterfaces() {
  SqliteQuery texts(
      file_, "SELECT topic_type, encoding, encoded_message_definition FROM message_definitions");
  std::map<std::string, std::pair<std::string, std::string>> interfaces;
  while (texts.Step() == SqliteQuery::Result::kRow) {
    interfaces[texts.Text(0)] = {texts.Text(1), texts.Text(2)};
  }
  SqliteQuery about(file_, "SELECT id, type, offered_qos_profiles FROM topics");
  while (about.Step() == SqliteQuery::Result::kRow) {
    const auto topic = topic_of_id_.find(about.Integer(0));
    if (topic == topic_of_id_.end()) continue;
    const auto& [language, text] = interfaces[about.Text(1)];
    SetInterface(language, text, about.Text(2), &topics_[topic->second]);
  }
}

void Db3Reader::Select(const std::vector<std::size_t>& topics) {
  selected_.assign(selected_.size(), false);
  for (const std::size_t topic : topics) selected_.at(topic) = true;
}

bool Db3Reader::Next(RawMessage* message) {
  std::int64_t row = 0;
  while (NextRow(&row)) {
    if (ReadRow(row, message)) return true;
  }
  return false;
}

bool Db3Reader::NextRow(std::int64_t* row) {
  while (order_ != Order::kEnded && rows_left_ > 0) {
    SqliteQuery* rows = order_ == Order::kByTime ? &by_time_ : &by_row_;
    const SqliteQuery::Result result = rows->Step();
    if (result == SqliteQuery::Result::kRow) {
      *row = rows->Integer(0);
      largest_row_ = std::max(largest_row_, *row);
      --rows_left_;
      return true;
    }
    if (result == SqliteQuery::Result::kDone) {
      order_ = Order::kEnded;
    } else if (order_ == Order::kByTime) {
      Warn("the index of times is broken (" + file_.LastError() +
           "): reading goes on in the order of the rows");
      order_ = Order::kByRow;
      by_row_.Restart(largest_row_);
    } else {
      Warn("no further message can be found (" + file_.LastError() + ")");
      order_ = Order::kEnded;
    }
  }
  return false;
}

bool Db3Reader::ReadRow(std::int64_t row, RawMessage* message) {
  head_.Restart(row);
  if (head_.Step() != SqliteQuery::Result::kRow) {
    ReportLostRow(0);
    return false;
  }
  const auto topic = topic_of_id_.find(head_.Integer(0));
  if (topic == topic_of_id_.end() || !selected_[topic->second]) return false;
  message->topic = topic->second;
  message->recorded_ns = head_.Integer(1);
  if (!data_.Read(row, &message->bytes)) {
    ReportLostRow(0);
    return false;
  }
  if (topics_[topic->second].encoding == Encoding::kCdr && !UnpackMessage(&message->bytes)) {
    ReportLostRow(message->bytes.size());
    return false;
  }
  return true;
}

void Db3Reader::ReportLostRow(std::uint64_t bytes) {
  report_.bytes_lost += bytes;
  if (++lost_rows_ == 1) {
    lost_rows_warning_ = report_.warnings.size();
    Warn("");
  }
  report_.warnings[lost_rows_warning_] = shown_.string() + ": " + CountOf(lost_rows_, "message") +
                                         " cannot be read, as the pages that hold them "
                                         "are missing or broken";
}

void Db3Reader::Warn(const std::string& sentence) {
  report_.damaged = true;
  report_.warnings.push_back(shown_.string() + ": " + sentence);
}

}  // namespace trajlo
