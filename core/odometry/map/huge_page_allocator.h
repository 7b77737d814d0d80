// SPDX-License-Identifier: MIT
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>

namespace trajlo {

/// An allocator for standard containers. Large arrays get huge pages (2 MiB), where the system has
/// them: a map is read all over, and with pages of 4 KiB the processor spends much of its time
/// finding them. An array that is freed goes back to the system at once.
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
    // A huge page begins at a multiple of its size: what lies before and after is given back.
    const std::size_t mapped = RoundUp(bytes) + kHugePage;
    void* memory =
        mmap(nullptr, mapped, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    const auto address = reinterpret_cast<std::uintptr_t>(memory);
    const std::size_t before = RoundUp(address) - address;
    char* begin = static_cast<char*>(memory) + before;
    if (before > 0) munmap(memory, before);
    munmap(begin + RoundUp(bytes), kHugePage - before);
    // Only advice: if it is not taken, nothing changes.
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
