// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "core/io/messages/raw_message.h"

namespace trajlo {

/// Writes the fields of a message one after the other, as WireReader reads them: ROS 1's encoding,
/// or CDR in little endian. The records of MCAP follow the rules of ROS 1.
class WireWriter {
 public:
  explicit WireWriter(Encoding encoding) : is_cdr_(encoding == Encoding::kCdr) {
    if (is_cdr_) bytes_.assign("\0\1\0\0", kCdrHeader);
  }

  bool is_cdr() const { return is_cdr_; }

  template <typename T>
  WireWriter& Put(T value) {
    static_assert(std::is_arithmetic_v<T> && !std::is_same_v<T, bool>);
    Align(sizeof(T));
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    bytes_.append(raw, sizeof(T));
    return *this;
  }

  WireWriter& PutString(std::string_view text) {
    Put(static_cast<std::uint32_t>(text.size() + (is_cdr_ ? 1 : 0)));
    bytes_.append(text);
    if (is_cdr_) bytes_ += '\0';
    return *this;
  }

  /// A sequence of bytes with its length before it.
  WireWriter& PutBlock(std::string_view block) {
    Put(static_cast<std::uint32_t>(block.size()));
    bytes_.append(block);
    return *this;
  }

  WireWriter& PutBytes(std::string_view bytes) {
    bytes_.append(bytes);
    return *this;
  }

  /// Makes room for `size` bytes, zero, to be filled by the caller before anything else is put.
  char* Extend(std::size_t size) {
    bytes_.resize(bytes_.size() + size);
    return bytes_.data() + bytes_.size() - size;
  }

  /// The next field begins at a multiple of `size`, which numbers see to by themselves.
  void Align(std::size_t size) {
    if (!is_cdr_) return;
    const std::size_t beyond = (bytes_.size() - kCdrHeader) % size;
    if (beyond != 0) bytes_.append(size - beyond, '\0');
  }

  std::size_t size() const { return bytes_.size(); }
  const std::string& bytes() const { return bytes_; }
  std::string Take() { return std::move(bytes_); }

 private:
  static constexpr std::size_t kCdrHeader = 4;

  bool is_cdr_;
  std::string bytes_;
};

}  // namespace trajlo
