// SPDX-License-Identifier: MIT
#include "core/io/ros2/unpack.h"

#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <vector>

namespace trajlo {
namespace {

/// A larger message or chunk is not a LiDAR's.
constexpr std::uint64_t kLargestOutput = 1ULL << 30;
/// Point clouds shrink to a half at best: more than this is allocated when it has come out.
constexpr std::size_t kUsualRatio = 16;
constexpr std::size_t kFirstBytes = 1U << 16;

/// One call of a decoder: how much it took and gave, whether its frame is complete or broken.
struct Progress {
  std::size_t taken = 0, given = 0;
  bool frame_done = false;
  std::string error;
};

class ZstdDecoder {
 public:
  Progress Step(std::string_view in, char* out, std::size_t room) {
    ZSTD_inBuffer from{in.data(), in.size(), 0};
    ZSTD_outBuffer to{out, room, 0};
    const std::size_t result = ZSTD_decompressStream(context_.get(), &to, &from);
    Progress progress{from.pos, to.pos, result == 0, {}};
    if (ZSTD_isError(result)) progress.error = ZSTD_getErrorName(result);
    return progress;
  }

 private:
  struct Free {
    void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
  };
  std::unique_ptr<ZSTD_DCtx, Free> context_{ZSTD_createDCtx()};
};

class Lz4Decoder {
 public:
  Lz4Decoder() {
    LZ4F_dctx* context = nullptr;
    LZ4F_createDecompressionContext(&context, LZ4F_VERSION);
    context_.reset(context);
  }

  Progress Step(std::string_view in, char* out, std::size_t room) {
    std::size_t taken = in.size();
    std::size_t given = room;
    const std::size_t result =
        LZ4F_decompress(context_.get(), out, &given, in.data(), &taken, nullptr);
    if (LZ4F_isError(result)) return {0, 0, false, LZ4F_getErrorName(result)};
    return {taken, given, result == 0, {}};
  }

 private:
  struct Free {
    void operator()(LZ4F_dctx* context) const { LZ4F_freeDecompressionContext(context); }
  };
  std::unique_ptr<LZ4F_dctx, Free> context_;
};

FileBytes Enlarged(const FileBytes& bytes, std::size_t filled, std::size_t size) {
  FileBytes larger(size);
  if (filled > 0) std::memcpy(larger.data(), bytes.data(), filled);
  return larger;
}

template <typename Decoder>
Unpacked UnpackWith(std::string_view packed, std::uint64_t size) {
  const auto limit = static_cast<std::size_t>(std::min(size, kLargestOutput));
  Unpacked result;
  result.bytes = FileBytes(std::min(limit, kUsualRatio * packed.size() + kFirstBytes));
  Decoder decoder;
  std::size_t filled = 0;
  bool done = packed.empty();
  while (!done && result.problem.empty()) {
    const std::size_t room = result.bytes.size() - filled;
    Progress step = decoder.Step(packed, result.bytes.data() + filled, room);
    packed.remove_prefix(step.taken);
    filled += step.given;
    done = step.frame_done && packed.empty();
    result.problem = std::move(step.error);
    if (done || step.taken + step.given > 0 || !result.problem.empty()) continue;
    if (room > 0) {
      result.problem = "the compressed bytes are cut";
    } else if (filled == limit) {
      result.problem = "more than the " + std::to_string(limit) + " bytes declared come out";
    } else {
      result.bytes = Enlarged(result.bytes, filled, std::min(limit, 2 * filled));
    }
  }
  result.bytes.Shrink(filled);
  return result;
}

bool IsZstdFrame(std::string_view bytes) {
  constexpr std::string_view kMagic = "\x28\xB5\x2F\xFD";
  return bytes.substr(0, kMagic.size()) == kMagic;
}

}  // namespace

Unpacked Unpack(Codec codec, std::string_view packed, std::uint64_t size) {
  return codec == Codec::kZstd ? UnpackWith<ZstdDecoder>(packed, size)
                               : UnpackWith<Lz4Decoder>(packed, size);
}

bool UnpackMessage(FileBytes* message) {
  if (!IsZstdFrame(message->view())) return true;
  // Where the frame does not know its size, this is ZSTD_CONTENTSIZE_UNKNOWN, which is huge.
  const auto size = ZSTD_getFrameContentSize(message->data(), message->size());
  Unpacked unpacked = Unpack(Codec::kZstd, message->view(), size);
  if (!unpacked.problem.empty()) return false;
  *message = std::move(unpacked.bytes);
  return true;
}

}  // namespace trajlo
