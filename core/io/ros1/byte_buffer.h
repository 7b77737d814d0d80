// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstring>
#include <memory>
#include <string_view>
#include <utility>

namespace trajlo::ros1 {

/// Bytes that are not zeroed, and that keep their memory when they become fewer: fresh memory for
/// every chunk would cost as much as lz4 does.
class ByteBuffer {
 public:
  ByteBuffer() = default;
  /// Leaves `other` empty.
  ByteBuffer(ByteBuffer&& other) noexcept { Swap(&other); }
  ByteBuffer& operator=(ByteBuffer&& other) noexcept {
    ByteBuffer taken(std::move(other));
    Swap(&taken);
    return *this;
  }

  char* data() { return data_.get(); }
  const char* data() const { return data_.get(); }
  std::size_t size() const { return size_; }
  std::size_t capacity() const { return capacity_; }
  std::string_view view() const { return {data_.get(), size_}; }
  /// What is there stays, as far as it fits.
  void Resize(std::size_t size) {
    if (size > capacity_) {
      std::unique_ptr<char[]> larger(new char[size]);
      if (size_ > 0) std::memcpy(larger.get(), data_.get(), size_);
      data_ = std::move(larger);
      capacity_ = size;
    }
    size_ = size;
  }

 private:
  void Swap(ByteBuffer* other) {
    std::swap(data_, other->data_);
    std::swap(size_, other->size_);
    std::swap(capacity_, other->capacity_);
  }

  std::unique_ptr<char[]> data_;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

}  // namespace trajlo::ros1
