// SPDX-License-Identifier: MIT
#include "core/io/ros2/cut_file_vfs.h"

#include <sqlite3.h>

#include <algorithm>

namespace trajlo {
namespace {

constexpr char kName[] = "trajlo_cut_file";
constexpr int kHeaderBytes = 100;

/// The calls of an open file: those of SQLite's own layer, two of them replaced.
struct FileMethods {
  sqlite3_io_methods methods;
  int (*read)(sqlite3_file*, void*, int, sqlite3_int64);
  int (*size)(sqlite3_file*, sqlite3_int64*);
};

const FileMethods& RealMethods(const sqlite3_file* file) {
  return *reinterpret_cast<const FileMethods*>(file->pMethods);
}

int ReadWhole(sqlite3_file* file, void* bytes, int size, sqlite3_int64 offset) {
  const int result = RealMethods(file).read(file, bytes, size, offset);
  return result == SQLITE_IOERR_SHORT_READ ? SQLITE_IOERR_READ : result;
}

int DeclaredSize(sqlite3_file* file, sqlite3_int64* size) {
  const int result = RealMethods(file).size(file, size);
  char header[kHeaderBytes];
  if (result == SQLITE_OK && ReadWhole(file, header, kHeaderBytes, 0) == SQLITE_OK) {
    *size = std::max(*size, static_cast<sqlite3_int64>(DeclaredDatabaseSize(header)));
  }
  return result;
}

/// Files that are opened as immutable all have the same calls.
const FileMethods& MethodsInsteadOf(const sqlite3_io_methods& real) {
  static const FileMethods methods = [&] {
    FileMethods copy{real, real.xRead, real.xFileSize};
    copy.methods.xRead = ReadWhole;
    copy.methods.xFileSize = DeclaredSize;
    return copy;
  }();
  return methods;
}

int Open(sqlite3_vfs* vfs, const char* name, sqlite3_file* file, int flags, int* out_flags) {
  auto* real = static_cast<sqlite3_vfs*>(vfs->pAppData);
  const int result = real->xOpen(real, name, file, flags, out_flags);
  if (result == SQLITE_OK && (flags & SQLITE_OPEN_MAIN_DB) != 0) {
    file->pMethods = &MethodsInsteadOf(*file->pMethods).methods;
  }
  return result;
}

std::uint32_t BigEndian(const char* at, int bytes) {
  std::uint32_t value = 0;
  for (int i = 0; i < bytes; ++i) value = value << 8 | static_cast<unsigned char>(at[i]);
  return value;
}

}  // namespace

const char* CutFileVfs() {
  static sqlite3_vfs vfs = [] {
    sqlite3_vfs* real = sqlite3_vfs_find(nullptr);
    sqlite3_vfs copy = *real;
    copy.pNext = nullptr;
    copy.zName = kName;
    copy.pAppData = real;
    copy.xOpen = Open;
    return copy;
  }();
  // SQLite does not open a file of a layer that it does not know.
  static const int registered = sqlite3_vfs_register(&vfs, 0);
  static_cast<void>(registered);
  return kName;
}

std::uint64_t DeclaredDatabaseSize(const char* header) {
  const std::uint32_t page_size = BigEndian(header + 16, 2);
  // The number of pages is valid only where these two counters agree.
  if (BigEndian(header + 24, 4) != BigEndian(header + 92, 4)) return 0;
  return std::uint64_t{BigEndian(header + 28, 4)} * (page_size == 1 ? 65536 : page_size);
}

}  // namespace trajlo
