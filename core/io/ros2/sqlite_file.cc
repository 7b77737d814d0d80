// SPDX-License-Identifier: MIT
#include "core/io/ros2/sqlite_file.h"

#include <cctype>
#include <cstring>
#include <string_view>

#include "core/io/errors.h"
#include "core/io/random_access_file.h"
#include "core/io/ros2/cut_file_vfs.h"

namespace trajlo {
namespace {

constexpr std::string_view kMark("SQLite format 3\0", 16);
constexpr std::size_t kHeaderBytes = 100;

std::string FileUri(const std::filesystem::path& path) {
  constexpr char kHex[] = "0123456789ABCDEF";
  std::string uri = "file:";
  for (const char c : std::filesystem::absolute(path).string()) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0 || c == '/' || c == '.' || c == '_' || c == '-') {
      uri += c;
    } else {
      uri += {'%', kHex[byte >> 4], kHex[byte & 15]};
    }
  }
  return uri;
}

bool HasUnfinishedWrites(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::exists(path.string() + "-wal", ignored) ||
         std::filesystem::exists(path.string() + "-journal", ignored);
}

}  // namespace

SqliteFile::SqliteFile(const std::filesystem::path& path, const std::filesystem::path& shown) {
  const RandomAccessFile file(path);
  const FileBytes header = file.Read(0, kHeaderBytes);
  if (header.view().substr(0, kMark.size()) != kMark || header.size() < kHeaderBytes) {
    throw InputError(shown,
                     "this is not an SQLite database: it does not begin with the format's mark",
                     "Give a file that ends with .db3, or a bag of another kind.");
  }
  size_ = file.size();
  const std::uint64_t declared = DeclaredDatabaseSize(header.data());
  missing_bytes_ = declared > size_ ? declared - size_ : 0;
  // "immutable" leaves no trace beside the file and needs no right to write there, but does not see
  // what a recorder that was killed left beside it; that can be read only where we may write.
  const std::string uri = FileUri(path);
  if ((HasUnfinishedWrites(path) && Open(uri + "?mode=ro")) ||
      Open(uri + "?mode=ro&immutable=1&vfs=" + CutFileVfs())) {
    return;
  }
  throw InputError(shown, "SQLite cannot read it: " + (database_ ? LastError() : "out of memory"),
                   "Its first pages are damaged; record it again.");
}

bool SqliteFile::Open(const std::string& uri) {
  sqlite3* database = nullptr;
  const int flags = SQLITE_OPEN_READONLY | SQLITE_OPEN_URI;
  const int result = sqlite3_open_v2(uri.c_str(), &database, flags, nullptr);
  database_.reset(database);
  if (result != SQLITE_OK) return false;
  return SqliteQuery(*this, "SELECT name FROM sqlite_master").Step() != SqliteQuery::Result::kError;
}

SqliteQuery::SqliteQuery(const SqliteFile& file, const std::string& sql) {
  sqlite3_stmt* statement = nullptr;
  sqlite3_prepare_v2(file.get(), sql.c_str(), -1, &statement, nullptr);
  statement_.reset(statement);
}

void SqliteQuery::Restart(std::int64_t value) {
  if (!statement_) return;
  sqlite3_reset(statement_.get());
  sqlite3_bind_int64(statement_.get(), 1, value);
}

SqliteQuery::Result SqliteQuery::Step() {
  if (!statement_) return Result::kError;
  const int result = sqlite3_step(statement_.get());
  return result == SQLITE_ROW    ? Result::kRow
         : result == SQLITE_DONE ? Result::kDone
                                 : Result::kError;
}

std::int64_t SqliteQuery::Integer(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}

std::string SqliteQuery::Text(int column) const {
  const auto* text = sqlite3_column_text(statement_.get(), column);
  return text == nullptr ? "" : reinterpret_cast<const char*>(text);
}

bool SqliteBlobs::Read(std::int64_t row, FileBytes* bytes) {
  if (!Seek(row)) {
    blob_.reset();
    return false;
  }
  const auto size = static_cast<std::size_t>(sqlite3_blob_bytes(blob_.get()));
  // Only a broken row can be larger than its file.
  if (size > file_->size()) return false;
  *bytes = FileBytes(size);
  return size == 0 ||
         sqlite3_blob_read(blob_.get(), bytes->data(), static_cast<int>(size), 0) == SQLITE_OK;
}

bool SqliteBlobs::Seek(std::int64_t row) {
  if (blob_) return sqlite3_blob_reopen(blob_.get(), row) == SQLITE_OK;
  sqlite3_blob* blob = nullptr;
  const int result = sqlite3_blob_open(file_->get(), "main", table_, column_, row, 0, &blob);
  blob_.reset(blob);
  return result == SQLITE_OK;
}

}  // namespace trajlo
