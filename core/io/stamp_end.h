// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "core/io/time_convention.h"

namespace trajlo {

/// Which end of a sweep the stamps mark, of times that count from its start: see
/// DeduceTimeConvention(). `last` and `span` are those of a usual sweep, in the file's unit. Adds
/// evidence and doubt to `found`.
StampAt JudgeStampEnd(const TimeEvidence& evidence, double last, double span,
                      TimeConvention* found);

/// "0.05 s before", "1.2 s after"
std::string BeforeOrAfter(double after_s);

}  // namespace trajlo
