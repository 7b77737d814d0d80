// SPDX-License-Identifier: MIT
#include "core/io/packets/velodyne_clock.h"

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <string>
#include <string_view>

#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

constexpr std::int64_t kHourNs = 3'600'000'000'000;
constexpr std::size_t kPositionPacketSize = 512;
constexpr std::size_t kSentenceAt = 206;

/// The field of that number of a comma-separated sentence.
std::string_view Field(std::string_view sentence, std::size_t number) {
  for (; number > 0; --number) {
    const std::size_t comma = sentence.find(',');
    if (comma == std::string_view::npos) return {};
    sentence.remove_prefix(comma + 1);
  }
  return sentence.substr(0, sentence.find(','));
}

/// Two digits; -1 if they are none.
int TwoDigits(std::string_view text, std::size_t at) {
  if (text.size() < at + 2) return -1;
  const char tens = text[at];
  const char ones = text[at + 1];
  if (tens < '0' || tens > '9' || ones < '0' || ones > '9') return -1;
  return 10 * (tens - '0') + (ones - '0');
}

bool ChecksumHolds(std::string_view sentence) {
  const std::size_t star = sentence.find('*');
  if (star == std::string_view::npos || star + 3 > sentence.size()) return false;
  unsigned sum = 0;
  for (const char c : sentence.substr(1, star - 1)) sum ^= static_cast<unsigned char>(c);
  return std::strtoul(std::string(sentence.substr(star + 1, 2)).c_str(), nullptr, 16) == sum;
}

}  // namespace

std::int64_t HourClock::AbsoluteNs(std::uint32_t past_hour_us,
                                   std::optional<std::int64_t> captured_ns) {
  const std::int64_t past_hour_ns = 1000 * static_cast<std::int64_t>(past_hour_us);
  std::int64_t near_ns = start_ns_.value_or(past_hour_ns);
  if (captured_ns) {
    near_ns = *captured_ns + ahead_ns_;
  } else if (last_ns_) {
    near_ns = *last_ns_;
  }
  // Times are after 1970, so that plain division finds the hour.
  const std::int64_t hours = std::max<std::int64_t>(near_ns - past_hour_ns + kHourNs / 2, 0);
  const std::int64_t time_ns = hours / kHourNs * kHourNs + past_hour_ns;
  if (captured_ns) ahead_ns_ = time_ns - *captured_ns;
  last_ns_ = time_ns;
  return time_ns;
}

bool IsVelodynePositionPacket(const std::uint8_t* data, std::size_t size) {
  return size == kPositionPacketSize && data[kSentenceAt] == '$';
}

std::optional<std::int64_t> GprmcTimeNs(const std::uint8_t* data, std::size_t size) {
  if (!IsVelodynePositionPacket(data, size)) return {};
  std::string_view sentence(reinterpret_cast<const char*>(data) + kSentenceAt,
                            kPositionPacketSize - kSentenceAt);
  sentence = sentence.substr(0, sentence.find_first_of(std::string_view("\r\n\0", 3)));
  // GN, GL, ... are the same sentence of receivers that know more satellites.
  if (sentence.size() < 6 || sentence.substr(3, 3) != "RMC" || !ChecksumHolds(sentence)) return {};
  const std::string_view clock = Field(sentence, 1);
  const std::string_view date = Field(sentence, 9);
  if (Field(sentence, 2) != "A") return {};
  std::tm utc{};
  utc.tm_hour = TwoDigits(clock, 0);
  utc.tm_min = TwoDigits(clock, 2);
  utc.tm_sec = TwoDigits(clock, 4);
  utc.tm_mday = TwoDigits(date, 0);
  utc.tm_mon = TwoDigits(date, 2) - 1;
  const int year = TwoDigits(date, 4);
  utc.tm_year = year < 80 ? year + 100 : year;
  const bool plausible = utc.tm_hour >= 0 && utc.tm_hour < 24 && utc.tm_min >= 0 &&
                         utc.tm_min < 60 && utc.tm_sec >= 0 && utc.tm_sec <= 60 &&
                         utc.tm_mday >= 1 && utc.tm_mday <= 31 && utc.tm_mon >= 0 &&
                         utc.tm_mon < 12 && year >= 0;
  if (!plausible) return {};
  return static_cast<std::int64_t>(timegm(&utc)) * kNsPerSecond;
}

}  // namespace trajlo
