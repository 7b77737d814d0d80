// SPDX-License-Identifier: MIT
// Runs a fuzz target over files and over the files of folders: the corpus as a test, without clang.
#include <algorithm>
#include <fstream>
#include <iostream>
#include <iterator>
#include <vector>

#include "tests/fuzz/fuzzing.h"

namespace {

using std::filesystem::path;

std::vector<path> FilesOf(int count, char** names) {
  std::vector<path> files;
  for (int i = 0; i < count; ++i) {
    if (!std::filesystem::is_directory(names[i])) {
      files.emplace_back(names[i]);
      continue;
    }
    for (const auto& entry : std::filesystem::directory_iterator(names[i])) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<path> files = FilesOf(argc - 1, argv + 1);
  for (const path& file : files) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) {
      std::cerr << file << ": cannot be opened\n";
      return 1;
    }
    // Before the target runs: the last line names the culprit.
    std::cout << file.string() << std::endl;
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    // A block of its own size: sanitizers then see the first byte read beyond it.
    const std::vector<std::uint8_t> input(bytes.begin(), bytes.end());
    LLVMFuzzerTestOneInput(input.data(), input.size());
  }
  std::cout << files.size() << " inputs\n";
  return files.empty() ? 1 : 0;
}
