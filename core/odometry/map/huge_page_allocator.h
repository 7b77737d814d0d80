// SPDX-License-Identifier: MIT
#pragma once

#include <sys/mman.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace trajlo {

/// Allocates for a standard container, what is large in huge pages of 2 MiB where the system has
/// them. A map is read all over: with pages of 4 KiB, finding a page costs about as much as what
/// is read from it.
template <typename T>
struct HugePageAllocator {
  using value_type = T;
  static constexpr std::size_t kHugePage = std::size_t{1} << 21;

  HugePageAllocator() = default;
  template <typename U>
  HugePageAllocator(const HugePageAllocator<U>& /*other*/) {}

  /// Throws std::bad_alloc.
  T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    const bool is_large = bytes >= kHugePage;
    const std::size_t alignment =
        is_large ? kHugePage : std::max(alignof(T), alignof(std::max_align_t));
    const std::size_t rounded = (bytes + alignment - 1) / alignment * alignment;
    void* memory = std::aligned_alloc(alignment, rounded);
    if (memory == nullptr) throw std::bad_alloc();
    // Only advice: where it is not taken, all is as it was.
    if (is_large) madvise(memory, rounded, MADV_HUGEPAGE);
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t /*count*/) { std::free(memory); }

  friend bool operator==(const HugePageAllocator& /*a*/, const HugePageAllocator& /*b*/) {
    return true;
  }
  friend bool operator!=(const HugePageAllocator& /*a*/, const HugePageAllocator& /*b*/) {
    return false;
  }
};

}  // namespace trajlo
