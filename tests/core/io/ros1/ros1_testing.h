// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <ostream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/io/ros1/bag_record.h"
#include "core/io/ros1/ros1_bag_reader.h"

namespace trajlo::testing {

/// A message with its topic by name.
struct BagMessage {
  std::string topic;
  std::int64_t recorded_ns = 0;
  std::string bytes;

  bool operator==(const BagMessage& other) const {
    return std::tie(topic, recorded_ns, bytes) ==
           std::tie(other.topic, other.recorded_ns, other.bytes);
  }
};

inline void PrintTo(const BagMessage& message, std::ostream* out) {
  *out << message.topic << " at " << message.recorded_ns << " ns, " << message.bytes.size()
       << " bytes";
}

/// What is left of it.
inline std::vector<BagMessage> ReadRest(Ros1BagReader* reader) {
  std::vector<BagMessage> all;
  RawMessage message;
  while (reader->Next(&message)) {
    all.push_back({reader->topics()[message.topic].name, message.recorded_ns,
                   std::string(message.bytes.view())});
  }
  return all;
}

inline std::vector<BagMessage> ReadBag(const std::filesystem::path& path) {
  Ros1BagReader reader(path);
  return ReadRest(&reader);
}

inline std::filesystem::path Fixture(const std::string& name) {
  return std::filesystem::path(TRAJLO_TEST_DIR) / "fixtures" / name;
}

/// What make_fixtures.py has put into each of its bags, in the order of recording.
inline std::vector<BagMessage> FixtureMessages() {
  std::vector<BagMessage> all;
  for (int i = 0; i < 60; ++i) {
    std::string bytes(20 + 37 * (i % 11), '\0');
    for (std::size_t j = 0; j < bytes.size(); ++j) bytes[j] = static_cast<char>((31 * i + j) % 251);
    all.push_back({i % 3 == 0 ? "/points" : "/pose",
                   1'600'000'000'000'000'000 + i * std::int64_t{10'000'000}, bytes});
  }
  return all;
}

/// Begin and end of the records of a whole bag.
inline std::vector<std::pair<std::size_t, std::size_t>> RecordsOf(const std::filesystem::path& bag,
                                                                  ros1::Op op) {
  const RandomAccessFile file(bag);
  std::vector<std::pair<std::size_t, std::size_t>> records;
  for (std::uint64_t offset = ros1::kMagic.size(); offset < file.size();) {
    const auto record = ros1::ReadRecord(file, offset);
    if (record->op == op) records.emplace_back(offset, record->end());
    offset = record->end();
  }
  return records;
}

/// The folder of recordings; the environment variable TRAJLO_DATA goes first.
inline std::filesystem::path SimulatedDir() {
  const char* set = std::getenv("TRAJLO_DATA");
  return std::filesystem::path(set != nullptr ? set : TRAJLO_DATA_DIR) / "simulated";
}

}  // namespace trajlo::testing
