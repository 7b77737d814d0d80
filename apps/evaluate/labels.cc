// SPDX-License-Identifier: MIT
#include "apps/evaluate/labels.h"

#include <algorithm>
#include <set>

namespace trajlo {
namespace {

using Parts = std::vector<std::string>;

bool AllDiffer(const std::vector<std::string>& names) {
  return std::set<std::string>(names.begin(), names.end()).size() == names.size();
}

void NumberEqualOnes(const char* separator, std::vector<std::string>* names) {
  std::set<std::string> taken;
  for (std::string& name : *names) {
    std::string candidate = name;
    for (int n = 2; !taken.insert(candidate).second; ++n) {
      candidate = name + separator + std::to_string(n);
    }
    name = candidate;
  }
}

/// Drops what all paths have in common at their ends.
std::vector<std::string> Differences(std::vector<Parts> paths) {
  const auto drop_common = [&] {
    while (std::all_of(paths.begin(), paths.end(), [&](const Parts& p) {
      return p.size() > 1 && p.back() == paths.front().back();
    })) {
      for (Parts& p : paths) p.pop_back();
    }
    for (Parts& p : paths) std::reverse(p.begin(), p.end());
  };
  drop_common();
  drop_common();
  std::vector<std::string> names;
  for (const Parts& parts : paths) {
    names.emplace_back();
    for (const std::string& part : parts) names.back() += (names.back().empty() ? "" : "/") + part;
  }
  return names;
}

}  // namespace

std::vector<std::string> Labels(const std::vector<std::filesystem::path>& files) {
  std::vector<std::string> names;
  std::vector<Parts> paths;
  for (const std::filesystem::path& file : files) {
    names.push_back(file.stem().string());
    Parts parts;
    for (const std::filesystem::path& part : file.parent_path()) parts.push_back(part.string());
    parts.push_back(file.stem().string());
    paths.push_back(parts);
  }
  if (!AllDiffer(names)) names = Differences(paths);
  NumberEqualOnes(" ", &names);
  return names;
}

std::vector<std::string> FileNames(const std::vector<std::string>& labels) {
  std::vector<std::string> names = labels;
  for (std::string& name : names) {
    for (char& c : name) {
      const auto byte = static_cast<unsigned char>(c);
      const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                         (c >= '0' && c <= '9') || c == '.' || c == '-' || byte >= 0x80;
      if (!plain) c = '_';
    }
  }
  NumberEqualOnes("_", &names);
  return names;
}

}  // namespace trajlo
