// SPDX-License-Identifier: MIT
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>

namespace trajlo {

/// Allocates for a standard container, what is large in huge pages of 2 MiB where the system has
/// them. A map is read all over: with pages of 4 KiB, finding a page costs about as much as what
/// is read from it. What is large goes back to the system when it is freed, as an array does that
/// has grown into a larger one.
template <typename T>
class HugePageAllocator {
 public:
  using value_type = T;

  HugePageAllocator() = default;
  template <typename U>
  HugePageAllocator(const HugePageAllocator<U>& /*other*/) {}

  /// Throws std::bad_alloc.
  T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    if (bytes < kHugePage) return std::allocator<T>().allocate(count);
    // A huge page begins at a multiple of its size: what is before and behind is given back.
    const std::size_t mapped = RoundUp(bytes) + kHugePage;
    void* memory =
        mmap(nullptr, mapped, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    const auto address = reinterpret_cast<std::uintptr_t>(memory);
    const std::size_t before = RoundUp(address) - address;
    char* begin = static_cast<char*>(memory) + before;
    if (before > 0) munmap(memory, before);
    munmap(begin + RoundUp(bytes), kHugePage - before);
    // Only advice: where it is not taken, all is as it was.
    madvise(begin, RoundUp(bytes), MADV_HUGEPAGE);
    return reinterpret_cast<T*>(begin);
  }
  void deallocate(T* memory, std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    if (bytes < kHugePage) return std::allocator<T>().deallocate(memory, count);
    munmap(memory, RoundUp(bytes));
  }

  friend bool operator==(const HugePageAllocator& /*a*/, const HugePageAllocator& /*b*/) {
    return true;
  }
  friend bool operator!=(const HugePageAllocator& /*a*/, const HugePageAllocator& /*b*/) {
    return false;
  }

 private:
  static constexpr std::size_t kHugePage = std::size_t{1} << 21;
  static std::size_t RoundUp(std::size_t bytes) {
    return (bytes + kHugePage - 1) / kHugePage * kHugePage;
  }
};

}  // namespace trajlo
