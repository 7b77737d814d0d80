// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "core/report/run_summary.h"

namespace trajlo {

/// The summary for people: a few lines of text, two columns.
std::string SummaryTable(const RunSummary& summary);

}  // namespace trajlo
