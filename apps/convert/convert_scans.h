// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>

#include "apps/convert/convert_job.h"
#include "core/io/scan_source.h"

namespace trajlo {

struct ConvertedScans {
  std::size_t scans = 0;
  std::size_t points = 0;
  std::size_t lidars = 0;
  ReadReport report;
};

/// Reads scans as trajlo_run does and writes them into a bag or a folder. Throws InputError and
/// OutputError.
ConvertedScans ConvertScans(const ConvertRequest& request, const std::atomic<bool>& stop);

}  // namespace trajlo
