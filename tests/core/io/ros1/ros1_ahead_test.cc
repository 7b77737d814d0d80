// SPDX-License-Identifier: MIT
// Chunks that other threads decompress ahead.
#include <gmock/gmock.h>

#include <cstring>
#include <random>

#include "core/io/errors.h"
#include "core/io/ros1/chunks_ahead.h"
#include "core/io/ros1/ros1_bag_reader.h"
#include "core/io/ros1/ros1_bag_writer.h"
#include "tests/core/io/ros1/ros1_testing.h"
#include "tests/support/temp_folder.h"

namespace trajlo::testing {
namespace {

const MessageDescription kString{"std_msgs/String", "992ce8a1687cec8c8bd883ec73ca41d1",
                                 "string data\n"};

/// Everything that a reader says, also where it refuses.
struct Reading {
  std::vector<BagMessage> messages;
  std::vector<std::string> sentences;
  std::uint64_t bytes_lost = 0;
};

Reading ReadWith(int threads, const std::filesystem::path& path) {
  Reading reading;
  try {
    Ros1BagReader reader(path, threads);
    reading.messages = ReadRest(&reader);
    reading.sentences = reader.report().warnings;
    reading.bytes_lost = reader.report().bytes_lost;
  } catch (const InputError& error) {
    reading.sentences.emplace_back(error.what());
  }
  return reading;
}

void ExpectSame(const Reading& a, const Reading& b) {
  EXPECT_EQ(a.messages, b.messages);
  EXPECT_EQ(a.sentences, b.sentences);
  EXPECT_EQ(a.bytes_lost, b.bytes_lost);
}

class AheadInFixture : public ::testing::TestWithParam<const char*> {};

TEST_P(AheadInFixture, MessagesDoNotDependOnThreads) {
  for (const int threads : {0, 2, 3, 16}) {
    EXPECT_EQ(ReadWith(threads, Fixture(GetParam())).messages, FixtureMessages()) << threads;
  }
}

TEST_P(AheadInFixture, OneTopicDoesNotDependOnThreads) {
  for (const std::size_t topic : {0U, 1U}) {
    Ros1BagReader alone(Fixture(GetParam())), ahead(Fixture(GetParam()), 4);
    alone.Select({topic});
    ahead.Select({topic});
    EXPECT_EQ(ReadRest(&ahead), ReadRest(&alone));
  }
}

TEST_P(AheadInFixture, WhatIsSaidOfDamageDoesNotDependOnThreads) {
  const TempFolder folder;
  const auto path = folder / "a.bag";
  const std::string whole = ReadFile(Fixture(GetParam()));
  std::mt19937 random(4);
  for (int round = 0; round < 60; ++round) {
    std::string bag = whole;
    for (int i = 0; i < 3; ++i) bag[4109 + random() % (bag.size() - 4109)] ^= 0x10;
    if (round % 3 == 0) bag.resize(4109 + random() % (bag.size() - 4109));
    WriteFile(path, bag);
    ExpectSame(ReadWith(4, path), ReadWith(1, path));
  }
}

TEST_P(AheadInFixture, ReadingMayEndAnywhere) {
  for (std::size_t count = 0; count < 60; count += 7) {
    Ros1BagReader reader(Fixture(GetParam()), 4);
    RawMessage message;
    for (std::size_t i = 0; i < count; ++i) ASSERT_TRUE(reader.Next(&message));
  }
}

INSTANTIATE_TEST_SUITE_P(All, AheadInFixture, ::testing::Values("none.bag", "bz2.bag", "lz4.bag"),
                         [](const auto& param) {
                           return std::filesystem::path(param.param).stem().string();
                         });

/// A bag with a message in each chunk, and where its chunks lie.
class ChunksOf {
 public:
  ChunksOf(BagCompression compression, std::size_t count, std::size_t bytes) {
    Ros1BagWriter writer(folder_ / "a.bag", {compression, 1});
    for (std::size_t i = 0; i < count; ++i) {
      writer.Write({"/a", kString}, static_cast<std::int64_t>(i), std::string(bytes, 'x'));
    }
    writer.Close();
    places_ = RecordsOf(path(), ros1::Op::kChunk);
  }

  std::filesystem::path path() const { return folder_ / "a.bag"; }
  /// Changes the size that the chunks say they have when they are decompressed.
  void LetThemClaim(std::uint32_t bytes) const {
    std::string bag = ReadFile(path());
    for (const auto& [begin, end] : places_) {
      std::memcpy(&bag[bag.find("size=", begin) + 5], &bytes, sizeof(bytes));
    }
    WriteFile(path(), bag);
  }
  /// How many of the chunks from `first` on may be started.
  std::size_t StartFrom(std::size_t first, ros1::ChunksAhead* ahead) const {
    std::size_t started = 0;
    while (first + started < places_.size() &&
           ahead->Start(places_[first + started].first, places_[first + started].second)) {
      ++started;
    }
    return started;
  }
  bool Take(std::size_t place, ros1::ChunksAhead* ahead, ros1::Chunk* chunk) const {
    return ahead->Take(places_[place].first, chunk);
  }

 private:
  TempFolder folder_;
  std::vector<std::pair<std::size_t, std::size_t>> places_;
};

TEST(ChunksAhead, NoMoreAreStartedThanThereAreThreadsNorThanWereTaken) {
  const ChunksOf bag(BagCompression::kBz2, 10, 100);
  const RandomAccessFile file(bag.path());
  ros1::ChunksAhead ahead(file, 3);
  ros1::Chunk chunk;
  EXPECT_EQ(bag.StartFrom(0, &ahead), 0U);
  EXPECT_FALSE(bag.Take(0, &ahead, &chunk));
  std::size_t next = 1, taken = 0;
  // One, two and then three are under way.
  for (const std::size_t more : {1U, 2U, 2U, 1U, 1U}) {
    EXPECT_EQ(bag.StartFrom(next, &ahead), more);
    next += more;
    EXPECT_TRUE(bag.Take(++taken, &ahead, &chunk));
    EXPECT_EQ(chunk.messages.front().recorded_ns, static_cast<std::int64_t>(taken));
  }
}

TEST(ChunksAhead, OneThreadReadsNothingAheadAndManyReadNoPlainOrLz4Chunk) {
  ros1::Chunk chunk;
  const ChunksOf compressed(BagCompression::kBz2, 4, 100);
  const RandomAccessFile compressed_file(compressed.path());
  ros1::ChunksAhead one(compressed_file, 1);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_FALSE(compressed.Take(i, &one, &chunk));
    EXPECT_EQ(compressed.StartFrom(i + 1, &one), 0U);
  }
  for (const BagCompression fast : {BagCompression::kNone, BagCompression::kLz4}) {
    const ChunksOf bag(fast, 4, 100);
    const RandomAccessFile file(bag.path());
    ros1::ChunksAhead many(file, 8);
    for (std::size_t i = 0, next = 1; i < 4; ++i) {
      EXPECT_FALSE(bag.Take(i, &many, &chunk)) << "that is for who takes it";
      next += bag.StartFrom(next, &many);
    }
  }
}

TEST(ChunksAhead, LargeChunksAreHeldTwoAtOnceAndHugeOnesNotAtAll) {
  const ChunksOf bag(BagCompression::kBz2, 6, 100);
  for (const auto& [megabytes, held] : {std::pair<std::uint32_t, std::size_t>{30, 2}, {65, 0}}) {
    bag.LetThemClaim(megabytes << 20U);
    const RandomAccessFile file(bag.path());
    ros1::ChunksAhead ahead(file, 4);
    ros1::Chunk chunk;
    for (int i = 0; i < 4; ++i) EXPECT_FALSE(ahead.Take(0, &chunk));
    EXPECT_EQ(bag.StartFrom(0, &ahead), held);
  }
}

}  // namespace
}  // namespace trajlo::testing
