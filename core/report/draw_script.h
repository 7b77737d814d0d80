// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace trajlo {

/// Lets a script of scripts/ ("draw_evaluation.py") draw figures and a page of an output folder;
/// waits for it. The script is looked for in the folder that the environment variable
/// TRAJLO_SCRIPTS names, else in share/trajlo/scripts beside the folder that this program is in
/// (a build has links there).
/// Returns why it did not work; empty if it did.
std::string RunDrawScript(const std::string& name, const std::filesystem::path& folder);

}  // namespace trajlo
