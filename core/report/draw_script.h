// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace trajlo {

/// How drawing ended.
struct DrawOutcome {
  /// Why it did not work; empty if it did.
  std::string problem;
  /// Something could not be written.
  bool output_failed = false;
};

/// Lets a script of scripts/ ("draw_evaluation.py") draw figures and a page of an output folder;
/// waits for it. The script is looked for in the folder that the environment variable
/// TRAJLO_SCRIPTS names, else in share/trajlo/scripts beside the folder that this program is in
/// (a build has links there).
/// The script's own messages are seen where those of this program are.
DrawOutcome RunDrawScript(const std::string& name, const std::filesystem::path& folder);

}  // namespace trajlo
