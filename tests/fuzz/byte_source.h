// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>

namespace trajlo::fuzz {

/// The bytes of an input as decisions, one after the other; zeros behind the last one.
class ByteSource {
 public:
  ByteSource(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  bool empty() const { return size_ == 0; }

  std::uint8_t Byte() {
    if (size_ == 0) return 0;
    --size_;
    return *data_++;
  }
  bool Bool() { return (Byte() & 1U) != 0; }

  /// Eight bytes, any value.
  std::int64_t Int64() {
    std::uint64_t value = 0;
    for (int i = 0; i < 8; ++i) value = value << 8U | Byte();
    std::int64_t number = 0;
    std::memcpy(&number, &value, sizeof(number));
    return number;
  }
  /// Four bytes, any value: NaN and infinity, too.
  float Float() {
    std::uint32_t bits = 0;
    for (int i = 0; i < 4; ++i) bits = bits << 8U | Byte();
    float value = 0.0F;
    std::memcpy(&value, &bits, sizeof(value));
    return value;
  }

  template <typename T>
  T OneOf(std::initializer_list<T> choices) {
    return choices.begin()[Byte() % choices.size()];
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
};

}  // namespace trajlo::fuzz
