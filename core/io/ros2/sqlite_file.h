// SPDX-License-Identifier: MIT
#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "core/io/file_bytes.h"

namespace trajlo {

/// An SQLite database, read only. Files that are shorter than they should be can be opened, too.
class SqliteFile {
 public:
  /// Throws InputError, with the name `shown`, when it is no database.
  SqliteFile(const std::filesystem::path& path, const std::filesystem::path& shown);

  sqlite3* get() const { return database_.get(); }
  /// SQLite's words for what went wrong last.
  std::string LastError() const { return sqlite3_errmsg(database_.get()); }
  std::uint64_t size() const { return size_; }
  /// How much of the file is cut off.
  std::uint64_t missing_bytes() const { return missing_bytes_; }

 private:
  struct Close {
    void operator()(sqlite3* database) const { sqlite3_close_v2(database); }
  };
  bool Open(const std::string& uri);

  std::unique_ptr<sqlite3, Close> database_;
  std::uint64_t size_ = 0;
  std::uint64_t missing_bytes_ = 0;
};

/// A prepared query. Columns are counted from 0, parameters from 1.
class SqliteQuery {
 public:
  enum class Result { kRow, kDone, kError };

  /// A query that cannot be prepared (no such table, broken schema) gives kError at its first step.
  SqliteQuery(const SqliteFile& file, const std::string& sql);

  /// Starts again with a new value of the first parameter.
  void Restart(std::int64_t value);
  Result Step();
  std::int64_t Integer(int column) const;
  std::string Text(int column) const;

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
  };
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

/// Reads a column of blobs row by row, straight into memory of the caller.
class SqliteBlobs {
 public:
  /// `file`, `table` and `column` must outlive it.
  SqliteBlobs(const SqliteFile* file, const char* table, const char* column)
      : file_(file), table_(table), column_(column) {}

  /// False if the row does not exist or cannot be read.
  bool Read(std::int64_t row, FileBytes* bytes);

 private:
  struct Close {
    void operator()(sqlite3_blob* blob) const { sqlite3_blob_close(blob); }
  };
  bool Seek(std::int64_t row);

  const SqliteFile* file_;
  const char* table_;
  const char* column_;
  std::unique_ptr<sqlite3_blob, Close> blob_;
};

}  // namespace trajlo
