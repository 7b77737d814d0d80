// SPDX-License-Identifier: MIT
#include "core/io/ros1/chunks_ahead.h"

#include <algorithm>
#include <system_error>
#include <thread>
#include <utility>

namespace trajlo::ros1 {
namespace {

constexpr std::uint64_t kMostBytes = std::uint64_t{64} << 20U;

std::size_t ThreadCount(int threads) {
  return static_cast<std::size_t>(
      std::max(1, threads > 0 ? threads : static_cast<int>(std::thread::hardware_concurrency())));
}

/// The memory that reading a chunk ahead takes; 0 if that is not worth a thread.
std::uint64_t BytesAhead(const RandomAccessFile& file, std::uint64_t offset, std::uint64_t limit) {
  const auto record = ReadRecord(file, offset);
  if (!record || record->op != Op::kChunk) return 0;
  const auto compression = record->fields().Find("compression");
  if (!compression || FindCompression(*compression) != BagCompression::kBz2) return 0;
  return limit - offset + record->fields().Number<std::uint32_t>("size").value_or(0);
}

}  // namespace

ChunksAhead::ChunksAhead(const RandomAccessFile& file, int threads)
    : file_(file), threads_(ThreadCount(threads)) {}

bool ChunksAhead::Start(std::uint64_t offset, std::uint64_t limit) {
  if (threads_ == 1 || jobs_.size() >= std::min(threads_, taken_)) return false;
  const std::uint64_t bytes = BytesAhead(file_, offset, limit);
  if (bytes_ + bytes > kMostBytes) return false;
  if (idle_.empty()) idle_.push_back(std::make_unique<Job>(file_));
  Job& job = *jobs_.emplace_back(std::move(idle_.back()));
  idle_.pop_back();
  job.offset = offset;
  job.bytes = bytes;
  bytes_ += bytes;
  if (bytes == 0) return true;
  try {
    job.done = std::async(std::launch::async,
                          [&job, offset, limit] { job.reader.Read(offset, limit, &job.chunk); });
  } catch (const std::system_error&) {
    // No more threads are to be had: the chunk is read when it is needed.
  }
  return true;
}

bool ChunksAhead::Take(std::uint64_t offset, Chunk* chunk) {
  ++taken_;
  if (jobs_.empty() || jobs_.front()->offset != offset) return false;
  const std::unique_ptr<Job>& job = idle_.emplace_back(std::move(jobs_.front()));
  jobs_.pop_front();
  bytes_ -= job->bytes;
  if (!job->done.valid()) return false;
  job->done.get();
  std::swap(*chunk, job->chunk);
  return true;
}

}  // namespace trajlo::ros1
