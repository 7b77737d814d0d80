// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>

#include "apps/convert/convert_job.h"
#include "apps/exit_code.h"

namespace trajlo {

/// Writes the result folder `request.input` for other tools; what, the name of the output tells:
/// .tum and .txt poses, .pcd and .ply the map, .bag, .mcap and .db3 everything, a folder the
/// deskewed scans. Throws InputError, OutputError and ConfigError.
ExitCode ExportResult(const ConvertRequest& request, const std::atomic<bool>& stop);

}  // namespace trajlo
