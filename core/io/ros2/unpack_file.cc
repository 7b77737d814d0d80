// SPDX-License-Identifier: MIT
#include <unistd.h>
#include <zstd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "core/io/errors.h"
#include "core/io/random_access_file.h"
#include "core/io/ros2/unpack.h"

namespace trajlo {
namespace {

constexpr std::size_t kPiece = 1U << 20;

struct Descriptor {
  int fd = -1;
  ~Descriptor() {
    if (fd >= 0) ::close(fd);
  }
};

struct FreeContext {
  void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
};

[[noreturn]] void FailToWrite(const std::filesystem::path& path,
                              const std::filesystem::path& folder) {
  throw InputError(path, "unpacking into " + folder.string() + " failed: " + std::strerror(errno),
                   "Make space there, or set TMPDIR to a folder that has it.");
}

bool WriteAll(int fd, const char* bytes, std::size_t size) {
  while (size > 0) {
    const ssize_t written = ::write(fd, bytes, size);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes += written;
    size -= static_cast<std::size_t>(written);
  }
  return true;
}

}  // namespace

TempFile::~TempFile() {
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove(path_, ignored);
}

TempFile UnpackFile(const std::filesystem::path& path, std::string* problem) {
  const RandomAccessFile file(path);
  const std::filesystem::path folder = std::filesystem::temp_directory_path();
  std::string name = (folder / "trajlo_XXXXXX").string();
  const Descriptor out{::mkstemp(name.data())};
  if (out.fd < 0) FailToWrite(path, folder);
  TempFile temp(name);
  const std::unique_ptr<ZSTD_DCtx, FreeContext> context(ZSTD_createDCtx());
  FileBytes buffer(kPiece);
  std::uint64_t offset = 0;
  std::size_t result = 0;
  problem->clear();
  while (offset < file.size() && problem->empty()) {
    const FileBytes piece = file.Read(offset, kPiece);
    if (piece.size() == 0) break;
    offset += piece.size();
    ZSTD_inBuffer from{piece.data(), piece.size(), 0};
    bool buffer_was_filled = false;
    while ((from.pos < from.size || buffer_was_filled) && problem->empty()) {
      ZSTD_outBuffer to{buffer.data(), buffer.size(), 0};
      result = ZSTD_decompressStream(context.get(), &to, &from);
      if (ZSTD_isError(result)) *problem = ZSTD_getErrorName(result);
      buffer_was_filled = to.pos == to.size && result != 0;
      if (!WriteAll(out.fd, buffer.data(), to.pos)) FailToWrite(path, folder);
    }
  }
  if (problem->empty() && result != 0) *problem = "the compressed bytes are cut";
  return temp;
}

}  // namespace trajlo
