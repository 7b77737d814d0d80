// SPDX-License-Identifier: MIT
#include <sstream>

#include "core/config/extrinsics_yaml.h"
#include "core/config/option.h"

namespace trajlo {
namespace {

constexpr std::size_t kColumns = 100;

/// The first sentence is what `trajlo_run --list_configs` says of the file.
std::string FirstSentence(DumpedOptions options) {
  switch (options) {
    case DumpedOptions::kForUsers:
      return "The options for users: their values, what they mean and what they may be.";
    case DumpedOptions::kForExperts:
      return "The options for research: their values, what they mean and what they may be.";
    case DumpedOptions::kAll:
      break;
  }
  return "The configuration of trajlo: options, their values, what they mean and what they may be.";
}

constexpr char kHeader[] =
    "# A config file needs only the keys that it changes; `--set=key=value` changes one for a "
    "run.\n"
    "# A sigma is a standard deviation, and a residual is divided by it.\n";

/// `text` as comment lines of at most kColumns columns.
std::string Comment(const std::string& text, const std::string& indent) {
  std::string lines, line;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (!line.empty() && indent.size() + 2 + line.size() + 1 + word.size() > kColumns) {
      lines += indent + "# " + line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return line.empty() ? lines : lines + indent + "# " + line + "\n";
}

std::vector<std::string> Split(const std::string& key) {
  std::vector<std::string> parts;
  std::istringstream stream(key);
  for (std::string part; std::getline(stream, part, '.');) parts.push_back(part);
  return parts;
}

/// Opens the sections of `parts` that the option before, of `open`, was not in.
std::string SectionHeads(const std::vector<std::string>& open,
                         const std::vector<std::string>& parts) {
  std::string text, section;
  bool same = true;
  for (std::size_t depth = 0; depth + 1 < parts.size(); ++depth) {
    section += (depth > 0 ? "." : "") + parts[depth];
    same = same && depth + 1 < open.size() && open[depth] == parts[depth];
    if (same) continue;
    const std::string indent(2 * depth, ' ');
    text += "\n" + Comment(SectionDoc(section), indent) + indent + parts[depth] + ":\n";
  }
  return text;
}

std::string ValueLines(const Option& option, const std::string& indent) {
  const auto* extrinsics = std::get_if<ExtrinsicsField>(&option.field);
  if (extrinsics == nullptr || extrinsics->value->empty()) return " " + ValueText(option) + "\n";
  std::string lines = "\n";
  for (const SE3& T : *extrinsics->value) lines += indent + "  - " + ExtrinsicText(T) + "\n";
  return lines;
}

}  // namespace

std::string DumpConfig(const RunConfig& config, DumpedOptions options) {
  RunConfig copy = config;  // Options are bound to something that they could change.
  std::string text = "# " + FirstSentence(options) + "\n" + kHeader;
  std::vector<std::string> open;
  for (const Option& option : BindOptions(&copy)) {
    const bool is_expert = option.key.rfind("expert.", 0) == 0;
    if (options == (is_expert ? DumpedOptions::kForUsers : DumpedOptions::kForExperts)) continue;
    const std::vector<std::string> parts = Split(option.key);
    const std::string indent(2 * (parts.size() - 1), ' ');
    text += parts.size() == 1 ? "\n" : SectionHeads(open, parts);
    text += Comment(option.doc + " (" + AllowedText(option) + ")", indent);
    text += indent + parts.back() + ":" + ValueLines(option, indent);
    open = parts;
  }
  return text;
}

std::vector<KeyInfo> ListKeys() {
  RunConfig defaults;
  std::vector<KeyInfo> keys;
  for (const Option& option : BindOptions(&defaults)) {
    keys.push_back(
        {option.key, AllowedText(option), ValueText(option), option.doc, ChoicesOf(option)});
  }
  return keys;
}

}  // namespace trajlo
