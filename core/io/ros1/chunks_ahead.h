// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <future>
#include <memory>
#include <vector>

#include "core/io/random_access_file.h"
#include "core/io/ros1/bag_chunk.h"

namespace trajlo::ros1 {

/// Decompresses chunks before they are asked for, each on a thread of its own: bz2 takes longer
/// than all that is done with the points. Plain and lz4 chunks, which do not, are left to who takes
/// them. What comes out is what ChunkReader reads.
///
/// Up to `threads` chunks are decompressed or wait to be taken, of together no more than 64 MB by
/// what they say of themselves; and no more than were taken already, so that who reads a few
/// messages only does not wait for many.
class ChunksAhead {
 public:
  /// `file` must outlive this. `threads` = 0 takes one for each core, 1 reads nothing ahead.
  ChunksAhead(const RandomAccessFile& file, int threads);

  /// Begins with a chunk (see ChunkReader::Read), which is taken after all that were started
  /// before. False if there is no room for it now.
  bool Start(std::uint64_t offset, std::uint64_t limit);
  /// Waits for the chunk at `offset`; `chunk` gives its memory in exchange. False if it is not
  /// read ahead. Throws what reading it threw.
  bool Take(std::uint64_t offset, Chunk* chunk);

 private:
  struct Job {
    explicit Job(const RandomAccessFile& file) : reader(file) {}

    std::uint64_t offset = 0;
    std::size_t bytes = 0;
    ChunkReader reader;
    Chunk chunk;
    /// Invalid if nothing is read ahead. Declared last: its destructor waits.
    std::future<void> done;
  };

  const RandomAccessFile& file_;
  std::size_t threads_;
  std::size_t taken_ = 0;
  std::size_t bytes_ = 0;
  std::deque<std::unique_ptr<Job>> jobs_;
  /// Those that are done with, for their memory.
  std::vector<std::unique_ptr<Job>> idle_;
};

}  // namespace trajlo::ros1
