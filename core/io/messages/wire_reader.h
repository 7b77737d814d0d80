// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <type_traits>

#include "core/io/messages/raw_message.h"

namespace trajlo {

/// Reads the fields of a serialised message one after the other, never beyond its end: once a field
/// does not fit, `ok()` is false and everything that is read is zero or empty.
///
/// ROS 1: little endian, packed, strings with their length before them.
/// CDR (OMG's Common Data Representation, as ROS 2 writes it): four bytes that name the byte order,
/// then every number at a multiple of its size, counted from behind those four bytes; strings end
/// with a NUL that their length includes.
/// MCAP's records follow the rules of ROS 1.
class WireReader {
 public:
  WireReader(std::string_view bytes, Encoding encoding) : bytes_(bytes) {
    if (encoding == Encoding::kRos1) return;
    is_cdr_ = true;
    // The first two bytes: 0 0 for big endian, 0 1 for little endian; others name encodings (with
    // parameter lists, of CDR's second version) that ROS 2 does not write.
    ok_ = bytes.size() >= kCdrHeader && bytes[0] == 0 && (bytes[1] == 0 || bytes[1] == 1);
    swap_bytes_ = ok_ && bytes[1] == 0;
    at_ = ok_ ? kCdrHeader : 0;
  }

  bool ok() const { return ok_; }
  bool is_cdr() const { return is_cdr_; }
  /// True if numbers stand in the other byte order.
  bool swap_bytes() const { return swap_bytes_; }
  /// Where the next field is looked for, from the start of the bytes.
  std::size_t position() const { return at_; }
  std::size_t remaining() const { return ok_ ? bytes_.size() - at_ : 0; }

  template <typename T>
  T Read() {
    static_assert(std::is_arithmetic_v<T>);
    Align(sizeof(T));
    const std::string_view raw = ReadBytes(sizeof(T));
    if (!ok_) return T{};
    char copy[sizeof(T)];
    std::memcpy(copy, raw.data(), sizeof(T));
    if (swap_bytes_) std::reverse(copy, copy + sizeof(T));
    T value;
    std::memcpy(&value, copy, sizeof(T));
    return value;
  }

  std::string_view ReadString() {
    const auto size = Read<std::uint32_t>();
    std::string_view text = ReadBytes(size);
    if (is_cdr_ && !text.empty() && text.back() == '\0') text.remove_suffix(1);
    return text;
  }

  std::string_view ReadBytes(std::size_t size) {
    if (!ok_ || size > bytes_.size() - at_) {
      ok_ = false;
      return {};
    }
    const std::string_view raw = bytes_.substr(at_, size);
    at_ += size;
    return raw;
  }

 private:
  static constexpr std::size_t kCdrHeader = 4;

  void Align(std::size_t size) {
    if (!is_cdr_ || !ok_) return;
    const std::size_t beyond = (at_ - kCdrHeader) % size;
    if (beyond != 0) ReadBytes(size - beyond);
  }

  std::string_view bytes_;
  std::size_t at_ = 0;
  bool is_cdr_ = false;
  bool swap_bytes_ = false;
  bool ok_ = true;
};

}  // namespace trajlo
