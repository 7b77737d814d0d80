// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace trajlo {

/// True for a whole number without a sign; false for an empty text.
bool AllDigits(std::string_view text);

/// Parses decimal text as nanoseconds without going through double: "1317042000.103499889",
/// "1.036224e-01", "-0.5". `unit_ns` is what a one in the text means, a power of ten from 1 to 1e9.
/// Digits beyond the nanosecond are rounded. Nothing if the text is no number or
/// farther from 0 than half the range, 146 years: differences of stamps never overflow.
std::optional<std::int64_t> ParseDecimalNs(std::string_view text, std::int64_t unit_ns);

/// Parses "2011-09-26 13:02:25.594360375" (a T in the middle and a Z at the end are accepted) as
/// nanoseconds since 1970; the text is taken as UTC. Nothing before 1824 or after 2115.
std::optional<std::int64_t> ParseDateTimeNs(std::string_view text);

/// What a one means in a stamp written as a whole number of that many digits, judged by the
/// century it gives: 19 digits are ns, 16 us, 13 ms, 10 or fewer s; nothing in between.
std::optional<std::int64_t> UnitOfWholeStampNs(std::string_view digits);

/// Prints nanoseconds as seconds with nine decimals, exactly: "1317042000.103499889".
std::string FormatSeconds(std::int64_t t_ns);

/// A stamp a line, as ReadStampsFile() takes them.
std::string FormatStampsFile(const std::vector<std::int64_t>& stamps_ns);

}  // namespace trajlo
