// SPDX-License-Identifier: MIT
#pragma once

#include "apps/compare/compare_request.h"

namespace trajlo {

/// Compares, writes the files and prints the tables. Throws InputError and OutputError.
void RunComparison(const CompareRequest& request);

}  // namespace trajlo
