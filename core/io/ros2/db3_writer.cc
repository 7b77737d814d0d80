// SPDX-License-Identifier: MIT
#include "core/io/ros2/db3_writer.h"

#include "core/io/errors.h"
#include "core/io/ros2/qos.h"

namespace trajlo {
namespace {

constexpr std::size_t kMaxMessage = std::size_t{1} << 29U;

/// The tables of rosbag2's fourth schema.
constexpr char kTables[] =
    "CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL);"
    "INSERT INTO schema VALUES(4, '');"
    "CREATE TABLE metadata(id INTEGER PRIMARY KEY, metadata_version INTEGER NOT NULL,"
    " metadata TEXT NOT NULL);"
    "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,"
    " serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL,"
    " type_description_hash TEXT NOT NULL);"
    "CREATE TABLE message_definitions(id INTEGER PRIMARY KEY, topic_type TEXT NOT NULL,"
    " encoding TEXT NOT NULL, encoded_message_definition TEXT NOT NULL,"
    " type_description_hash TEXT NOT NULL);"
    "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL,"
    " timestamp INTEGER NOT NULL, data BLOB NOT NULL);"
    "CREATE INDEX timestamp_idx ON messages (timestamp ASC);";

}  // namespace

Db3Writer::Db3Writer(const std::filesystem::path& path, IfExists if_exists) : path_(path) {
  file_.emplace(path, if_exists);
  sqlite3* database = nullptr;
  // An empty file is an empty database.
  const int result =
      sqlite3_open_v2(file_->part_path().c_str(), &database, SQLITE_OPEN_READWRITE, nullptr);
  database_.reset(database);
  Check(result);
  // What is broken is thrown away as a whole, and the file is synchronised at its end.
  Execute("PRAGMA journal_mode = OFF");
  Execute("PRAGMA synchronous = OFF");
  Execute("BEGIN");
  Execute(kTables);
  insert_message_ = Prepare("INSERT INTO messages(topic_id, timestamp, data) VALUES(?1, ?2, ?3)");
}

void Db3Writer::Write(const TopicDescription& topic, std::int64_t recorded_ns,
                      std::string_view message) {
  if (!file_) throw OutputError(path_, "writing after Close");
  if (message.size() > kMaxMessage) {
    throw OutputError(path_,
                      "a message of " + std::to_string(message.size()) + " bytes is too long");
  }
  sqlite3_stmt* insert = insert_message_.get();
  Check(sqlite3_bind_int64(insert, 1, IdOf(topic)));
  Check(sqlite3_bind_int64(insert, 2, recorded_ns));
  Check(sqlite3_bind_blob64(insert, 3, message.data(), message.size(), SQLITE_STATIC));
  Step(insert);
}

void Db3Writer::Close() {
  if (!file_) return;
  Execute("COMMIT");
  insert_message_.reset();
  database_.reset();
  file_->Commit();
  file_.reset();
}

std::int64_t Db3Writer::IdOf(const TopicDescription& topic) {
  const std::string type = Ros2TypeName(topic.message.type);
  const auto id = static_cast<std::int64_t>(ids_.size() + 1);
  const auto [place, is_new] = ids_.try_emplace(topic.name + " " + type, id);
  if (!is_new) return place->second;
  const Statement insert = Prepare("INSERT INTO topics VALUES(?1, ?2, ?3, 'cdr', ?4, '')");
  Check(sqlite3_bind_int64(insert.get(), 1, id));
  BindText(insert.get(), 2, topic.name);
  BindText(insert.get(), 3, type);
  BindText(insert.get(), 4, QosText(topic));
  Step(insert.get());
  if (!topic.message.definition.empty() && defined_.try_emplace(type, true).second) {
    const Statement define = Prepare(
        "INSERT INTO message_definitions(topic_type, encoding, encoded_message_definition,"
        " type_description_hash) VALUES(?1, ?2, ?3, '')");
    BindText(define.get(), 1, type);
    BindText(define.get(), 2, Ros2Language(topic.message));
    BindText(define.get(), 3, Ros2Text(topic.message));
    Step(define.get());
  }
  return id;
}

void Db3Writer::Check(int result) const {
  if (result == SQLITE_OK || result == SQLITE_DONE || result == SQLITE_ROW) return;
  throw OutputError(path_, std::string("writing failed: ") + sqlite3_errmsg(database_.get()));
}

void Db3Writer::Execute(const char* sql) {
  Check(sqlite3_exec(database_.get(), sql, nullptr, nullptr, nullptr));
}

Db3Writer::Statement Db3Writer::Prepare(const char* sql) {
  sqlite3_stmt* statement = nullptr;
  const int result = sqlite3_prepare_v2(database_.get(), sql, -1, &statement, nullptr);
  Statement owned(statement);
  Check(result);
  return owned;
}

void Db3Writer::BindText(sqlite3_stmt* statement, int place, const std::string& text) {
  Check(sqlite3_bind_text(statement, place, text.c_str(), static_cast<int>(text.size()),
                          SQLITE_TRANSIENT));
}

void Db3Writer::Step(sqlite3_stmt* statement) {
  Check(sqlite3_step(statement));
  Check(sqlite3_reset(statement));
  Check(sqlite3_clear_bindings(statement));
}

}  // namespace trajlo
