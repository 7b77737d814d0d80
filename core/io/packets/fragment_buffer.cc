// SPDX-License-Identifier: MIT
#include "core/io/packets/fragment_buffer.h"

#include <algorithm>

namespace trajlo {
namespace {

constexpr std::size_t kMostPending = 64;
constexpr std::size_t kLongestPacket = 65535;
/// Identifiers come round again; what is older belongs to another packet.
constexpr std::int64_t kPatienceNs = 1'000'000'000;

}  // namespace

bool FragmentBuffer::Pending::IsComplete() const {
  if (total == 0) return false;
  std::size_t end = 0;
  for (const auto& [begin, size] : pieces) {
    if (begin != end) return false;
    end += size;
  }
  return end == total;
}

const std::vector<std::uint8_t>* FragmentBuffer::Add(const IpPacket& piece,
                                                     std::int64_t captured_ns) {
  const std::size_t end = piece.fragment_offset + piece.size;
  if (end > kLongestPacket) return nullptr;
  auto at = std::find_if(pending_.begin(), pending_.end(), [&](const Pending& pending) {
    return pending.id == piece.fragment_id && pending.source == piece.source &&
           pending.destination == piece.destination;
  });
  if (at != pending_.end() &&
      (captured_ns - at->started_ns > kPatienceNs || captured_ns - at->started_ns < -kPatienceNs)) {
    pending_.erase(at);
    at = pending_.end();
    ++given_up_;
  }
  if (at == pending_.end()) {
    if (pending_.size() == kMostPending) {
      pending_.pop_front();
      ++given_up_;
    }
    pending_.push_back(
        {piece.source, piece.destination, piece.fragment_id, captured_ns, {}, {}, 0});
    at = std::prev(pending_.end());
  }
  if (at->bytes.size() < end) at->bytes.resize(end);
  std::copy_n(piece.data, piece.size, at->bytes.begin() + piece.fragment_offset);
  at->pieces[piece.fragment_offset] = piece.size;
  if (!piece.more_fragments) at->total = end;
  if (!at->IsComplete()) return nullptr;
  whole_ = std::move(at->bytes);
  whole_.resize(at->total);
  pending_.erase(at);
  return &whole_;
}

}  // namespace trajlo
