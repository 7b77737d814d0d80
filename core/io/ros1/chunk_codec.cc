// SPDX-License-Identifier: MIT
#include "core/io/ros1/chunk_codec.h"

#include <bzlib.h>
#include <lz4frame.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <stdexcept>

namespace trajlo::ros1 {
namespace {

// Recorders close a chunk at 768 KiB or behind the message that exceeds it.
constexpr std::size_t kMaxChunkBytes = std::size_t{1} << 30U;
constexpr std::size_t kMinRoom = 1U << 16U;

/// A buffer that grows as it is filled.
class Output {
 public:
  Output(std::size_t room, ByteBuffer* buffer) : buffer_(buffer) {
    buffer_->Resize(std::max(room, buffer_->capacity()));
  }
  ~Output() { buffer_->Resize(filled_); }

  char* end() { return buffer_->data() + filled_; }
  std::size_t room() const { return buffer_->size() - filled_; }
  void Advance(std::size_t count) { filled_ += count; }
  /// False if there is enough already.
  bool Grow() {
    if (buffer_->size() >= kMaxChunkBytes) return false;
    buffer_->Resize(std::min(2 * buffer_->size(), kMaxChunkBytes));
    return true;
  }

 private:
  ByteBuffer* buffer_;
  std::size_t filled_ = 0;
};

constexpr const char* kCut = "its compressed data is cut";
constexpr const char* kTooLarge = "it holds more than 1 GiB";

void DecompressBz2(std::string_view stored, Output* out, Decompressor::Result* result) {
  // In pieces, so that `consumed` tells how far the output reaches.
  constexpr std::size_t kPiece = 1U << 16U;
  bz_stream stream{};
  if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) throw std::bad_alloc();
  const std::unique_ptr<bz_stream, int (*)(bz_stream*)> guard(&stream, BZ2_bzDecompressEnd);
  // The library does not write through next_in, but it is old enough to lack the const.
  stream.next_in = const_cast<char*>(stored.data());
  std::size_t given = 0;
  while (true) {
    if (stream.avail_in == 0 && given < stored.size()) {
      stream.avail_in = static_cast<unsigned>(std::min(kPiece, stored.size() - given));
      given += stream.avail_in;
    }
    if (out->room() == 0 && !out->Grow()) {
      result->damage = kTooLarge;
      return;
    }
    const auto room = static_cast<unsigned>(out->room());
    stream.next_out = out->end();
    stream.avail_out = room;
    const int code = BZ2_bzDecompress(&stream);
    const unsigned written = room - stream.avail_out;
    out->Advance(written);
    if (written > 0 || code == BZ_STREAM_END) result->consumed = given - stream.avail_in;
    if (code == BZ_STREAM_END) return;
    if (code != BZ_OK) {
      result->damage = "its bz2 data is broken";
      return;
    }
    if (written == 0 && stream.avail_in == 0 && given == stored.size()) {
      result->damage = kCut;
      return;
    }
  }
}

void DecompressLz4(std::string_view stored, LZ4F_dctx* context, Output* out,
                   Decompressor::Result* result) {
  // Block by block, as large as the library asks for, so that `consumed` tells how far the output
  // reaches.
  std::size_t wanted = LZ4F_HEADER_SIZE_MIN;
  std::size_t read = 0;
  while (wanted > 0) {
    if (out->room() == 0 && !out->Grow()) {
      result->damage = kTooLarge;
      return;
    }
    std::size_t given = std::min(wanted, stored.size() - read);
    std::size_t written = out->room();
    wanted = LZ4F_decompress(context, out->end(), &written, stored.data() + read, &given, nullptr);
    if (LZ4F_isError(wanted)) {
      result->damage = std::string("its lz4 data is broken (") + LZ4F_getErrorName(wanted) + ")";
      return;
    }
    out->Advance(written);
    read += given;
    if (written > 0 || wanted == 0) result->consumed = read;
    if (wanted > 0 && given == 0 && written == 0) {
      result->damage = kCut;
      return;
    }
  }
}

}  // namespace

std::string_view CompressionName(BagCompression compression) {
  switch (compression) {
    case BagCompression::kNone:
      return "none";
    case BagCompression::kBz2:
      return "bz2";
    case BagCompression::kLz4:
      return "lz4";
  }
  return "";
}

std::optional<BagCompression> FindCompression(std::string_view name) {
  for (const auto compression :
       {BagCompression::kNone, BagCompression::kBz2, BagCompression::kLz4}) {
    if (name == CompressionName(compression)) return compression;
  }
  return std::nullopt;
}

Decompressor::Result Decompressor::Decompress(BagCompression compression, std::string_view stored,
                                              std::uint64_t declared_size, ByteBuffer* plain) {
  const std::size_t most = std::min(16 * stored.size() + kMinRoom, kMaxChunkBytes);
  Output out(std::clamp<std::size_t>(declared_size, kMinRoom, most), plain);
  Result result;
  if (compression == BagCompression::kBz2) {
    DecompressBz2(stored, &out, &result);
    return result;
  }
  if (lz4_ == nullptr) {
    LZ4F_dctx* context = nullptr;
    if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION))) {
      throw std::bad_alloc();
    }
    lz4_ = {context, [](LZ4F_dctx* dctx) { LZ4F_freeDecompressionContext(dctx); }};
  }
  LZ4F_resetDecompressionContext(lz4_.get());
  DecompressLz4(stored, lz4_.get(), &out, &result);
  return result;
}

std::string Compress(BagCompression compression, std::string_view bytes) {
  if (compression == BagCompression::kNone) return std::string(bytes);
  std::string stored;
  if (compression == BagCompression::kBz2) {
    auto size = static_cast<unsigned>(bytes.size() + bytes.size() / 100 + 601);
    stored.resize(size);
    const int code = BZ2_bzBuffToBuffCompress(stored.data(), &size, const_cast<char*>(bytes.data()),
                                              static_cast<unsigned>(bytes.size()), 9, 0, 0);
    if (code != BZ_OK) throw std::runtime_error("bz2 cannot compress a chunk");
    stored.resize(size);
    return stored;
  }
  LZ4F_preferences_t preferences{};
  preferences.frameInfo.blockMode = LZ4F_blockIndependent;
  preferences.frameInfo.blockSizeID = LZ4F_max64KB;  // Of a cut chunk whole blocks are left.
  preferences.frameInfo.contentChecksumFlag = LZ4F_contentChecksumEnabled;
  stored.resize(LZ4F_compressFrameBound(bytes.size(), &preferences));
  const std::size_t size =
      LZ4F_compressFrame(stored.data(), stored.size(), bytes.data(), bytes.size(), &preferences);
  if (LZ4F_isError(size)) throw std::runtime_error("lz4 cannot compress a chunk");
  stored.resize(size);
  return stored;
}

}  // namespace trajlo::ros1
