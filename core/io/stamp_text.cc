// SPDX-License-Identifier: MIT
#include "core/io/stamp_text.h"

#include <charconv>
#include <cstdlib>
#include <ctime>
#include <limits>

#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

// Half the range (until the year 2116), so that a difference of two stamps never overflows.
constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max() / 2;
constexpr int kFirstYear = 1824, kLastYear = 2115;

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

/// sign * digits * 10^exponent
struct Decimal {
  bool negative = false;
  std::string digits;
  int exponent = 0;
};

std::optional<Decimal> SplitDecimal(std::string_view text) {
  Decimal decimal;
  if (!text.empty() && (text.front() == '-' || text.front() == '+')) {
    decimal.negative = text.front() == '-';
    text.remove_prefix(1);
  }
  bool fraction = false;
  std::size_t at = 0;
  for (; at < text.size() && (IsDigit(text[at]) || (text[at] == '.' && !fraction)); ++at) {
    if (text[at] == '.') {
      fraction = true;
      continue;
    }
    decimal.digits += text[at];
    if (fraction) --decimal.exponent;
  }
  if (decimal.digits.empty() || decimal.digits.size() > 60) return {};
  if (at == text.size()) return decimal;
  if (text[at] != 'e' && text[at] != 'E') return {};
  ++at;
  if (at < text.size() && text[at] == '+') ++at;
  int exponent = 0;
  const auto [stop, error] = std::from_chars(text.data() + at, text.data() + text.size(), exponent);
  if (error != std::errc() || stop != text.data() + text.size() || std::abs(exponent) > 100) {
    return {};
  }
  decimal.exponent += exponent;
  return decimal;
}

/// The number in text[begin, begin + size); -1 if it is not all digits.
int Digits(std::string_view text, std::size_t begin, std::size_t size) {
  int value = 0;
  for (std::size_t i = begin; i < begin + size; ++i) {
    if (!IsDigit(text[i])) return -1;
    value = 10 * value + (text[i] - '0');
  }
  return value;
}

}  // namespace

bool AllDigits(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

std::optional<std::int64_t> ParseDecimalNs(std::string_view text, std::int64_t unit_ns) {
  std::optional<Decimal> decimal = SplitDecimal(text);
  if (!decimal) return {};
  int exponent = decimal->exponent;
  for (std::int64_t unit = unit_ns; unit > 1; unit /= 10) ++exponent;
  bool round_up = false;
  for (; exponent < 0; ++exponent) {
    round_up = !decimal->digits.empty() && decimal->digits.back() >= '5';
    if (!decimal->digits.empty()) decimal->digits.pop_back();
  }
  std::int64_t value = 0;
  for (const char c : decimal->digits) {
    if (value > (kMax - (c - '0')) / 10) return {};
    value = 10 * value + (c - '0');
  }
  for (; exponent > 0 && value != 0; --exponent) {
    if (value > kMax / 10) return {};
    value *= 10;
  }
  if (round_up) ++value;
  return decimal->negative ? -value : value;
}

std::optional<std::int64_t> ParseDateTimeNs(std::string_view text) {
  if (!text.empty() && text.back() == 'Z') text.remove_suffix(1);
  if (text.size() < 19 || text[4] != '-' || text[7] != '-' ||
      (text[10] != ' ' && text[10] != 'T') || text[13] != ':' || text[16] != ':') {
    return {};
  }
  const int year = Digits(text, 0, 4);
  const int month = Digits(text, 5, 2);
  const int day = Digits(text, 8, 2);
  const int hour = Digits(text, 11, 2);
  const int minute = Digits(text, 14, 2);
  if (year < kFirstYear || year > kLastYear || month < 1 || month > 12 || day < 1 || day > 31 ||
      hour < 0 || hour > 23 || minute < 0 || minute > 59 || !IsDigit(text[17])) {
    return {};
  }
  const auto seconds_ns = ParseDecimalNs(text.substr(17), kNsPerSecond);
  if (!seconds_ns || *seconds_ns > 61'000'000'000) return {};
  std::tm date{};
  date.tm_year = year - 1900;
  date.tm_mon = month - 1;
  date.tm_mday = day;
  date.tm_hour = hour;
  date.tm_min = minute;
  return std::int64_t{::timegm(&date)} * kNsPerSecond + *seconds_ns;
}

std::optional<std::int64_t> UnitOfWholeStampNs(std::string_view digits) {
  if (digits.size() == 18 || digits.size() == 19) return 1;
  if (digits.size() == 15 || digits.size() == 16) return 1'000;
  if (digits.size() == 12 || digits.size() == 13) return 1'000'000;
  if (digits.size() <= 10) return kNsPerSecond;
  return {};
}

std::string FormatSeconds(std::int64_t t_ns) {
  // Unsigned, because the smallest int64 has no positive counterpart.
  const std::uint64_t magnitude =
      t_ns < 0 ? 0 - static_cast<std::uint64_t>(t_ns) : static_cast<std::uint64_t>(t_ns);
  const std::string fraction = std::to_string(magnitude % kNsPerSecond);
  return (t_ns < 0 ? "-" : "") + std::to_string(magnitude / kNsPerSecond) + "." +
         std::string(9 - fraction.size(), '0') + fraction;
}

std::string FormatStampsFile(const std::vector<std::int64_t>& stamps_ns) {
  std::string text;
  for (const std::int64_t t_ns : stamps_ns) text += FormatSeconds(t_ns) + "\n";
  return text;
}

}  // namespace trajlo
