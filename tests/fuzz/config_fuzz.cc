// SPDX-License-Identifier: MIT
// The configuration as YAML; behind a line of "---8<---" come the settings of the command line.
#include "core/config/config.h"
#include "tests/fuzz/fuzzing.h"

namespace {

constexpr std::string_view kCut = "---8<---\n";

/// What can be loaded can be written, and what is written says the same.
void RequireRoundTrip(const trajlo::RunConfig& config) {
  const std::string dump = trajlo::DumpConfig(config);
  trajlo::RunConfig again;
  try {
    trajlo::LoadConfigText(dump, "dump", &again);
  } catch (const trajlo::ConfigError& error) {
    std::fprintf(stderr, "%s\n%s", error.what(), dump.c_str());
    trajlo::fuzz::Require(false, "a configuration that was written can be read");
  }
  trajlo::fuzz::Require(trajlo::DumpConfig(again) == dump, "it says the same");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trajlo;
  const std::string_view text = fuzz::AsText(data, size);
  const std::size_t cut = text.find(kCut);
  RunConfig config;
  try {
    LoadConfigText(std::string(text.substr(0, cut)), "input", &config);
    if (cut != text.npos) ApplyOverrides(text.substr(cut + kCut.size()), &config);
    RequireRoundTrip(config);
    CheckConfig(config);
  } catch (const ConfigError&) {
  }
  return 0;
}
