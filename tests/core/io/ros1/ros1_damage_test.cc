// SPDX-License-Identifier: MIT
// Bags that are cut, were never closed or have flipped bytes.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <new>
#include <random>
#include <set>

#include "core/io/errors.h"
#include "core/io/ros1/bag_chunk.h"
#include "core/io/ros1/bag_record.h"
#include "core/io/ros1/ros1_bag_reader.h"
#include "core/io/ros1/ros1_bag_writer.h"
#include "tests/core/io/ros1/ros1_testing.h"
#include "tests/support/temp_folder.h"

namespace {
std::size_t g_largest_allocation = 0;
}

// Every block that the reader allocates itself comes through here. Not inlined: GCC would miss that
// new and delete belong together.
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept {
  g_largest_allocation = std::max(g_largest_allocation, size);
  return std::malloc(size > 0 ? size : 1);
}
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (void* block = operator new(size, std::nothrow)) return block;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* block) noexcept { std::free(block); }
[[gnu::noinline]] void operator delete(void* block, std::size_t) noexcept { std::free(block); }

namespace trajlo::testing {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

const MessageDescription kString{"std_msgs/String", "992ce8a1687cec8c8bd883ec73ca41d1",
                                 "string data\n"};

/// The messages that are left; none if the bag is refused. Those have to be unharmed.
std::size_t CountUnharmed(const std::filesystem::path& bag,
                          const std::vector<BagMessage>& expected) {
  try {
    const std::vector<BagMessage> found = ReadBag(bag);
    EXPECT_TRUE(std::includes(
        expected.begin(), expected.end(), found.begin(), found.end(),
        [](const BagMessage& a, const BagMessage& b) { return a.recorded_ns < b.recorded_ns; }));
    for (const BagMessage& message : found) {
      EXPECT_EQ(std::count(expected.begin(), expected.end(), message), 1);
    }
    return found.size();
  } catch (const InputError&) {
    return 0;
  }
}

class DamagedBag : public ::testing::TestWithParam<const char*> {
 protected:
  std::filesystem::path Copy() const {
    const auto path = folder_ / "a.bag";
    std::filesystem::copy_file(Fixture(GetParam()), path,
                               std::filesystem::copy_options::overwrite_existing);
    return path;
  }
  /// Cuts a copy at these bytes, the last ones first.
  void ExpectThatLongerIsNeverLess(const std::set<std::size_t>& cuts) const {
    const std::vector<BagMessage> expected = FixtureMessages();
    const auto path = Copy();
    std::size_t count = expected.size();
    for (auto cut = cuts.rbegin(); cut != cuts.rend(); ++cut) {
      std::filesystem::resize_file(path, *cut);
      const std::size_t left = CountUnharmed(path, expected);
      ASSERT_LE(left, count) << "cut at " << *cut;
      count = left;
    }
  }

  TempFolder folder_;
};

TEST_P(DamagedBag, CutAtAnyByteBehindTheStartOfTheLastChunkGivesNoLessThanCutEarlier) {
  const auto path = Fixture(GetParam());
  const std::size_t last_chunk = RecordsOf(path, ros1::Op::kChunk).back().first;
  std::set<std::size_t> cuts;
  for (std::size_t at = last_chunk; at < std::filesystem::file_size(path); ++at) cuts.insert(at);
  ExpectThatLongerIsNeverLess(cuts);
}

TEST_P(DamagedBag, CutAtRandomBytesGivesNoLessThanCutEarlier) {
  std::mt19937 random(1);
  std::set<std::size_t> cuts;
  while (cuts.size() < 1000)
    cuts.insert(random() % std::filesystem::file_size(Fixture(GetParam())));
  ExpectThatLongerIsNeverLess(cuts);
}

TEST_P(DamagedBag, WithFlippedBytesNeitherCrashesNorTakesMemory) {
  const auto path = folder_ / "a.bag";
  const std::string whole = ReadFile(Fixture(GetParam()));
  std::mt19937 random(2);
  std::size_t found = 0;
  g_largest_allocation = 0;
  for (int round = 0; round < 1000; ++round) {
    std::string bag = whole;
    const int flips = 1 + round % 3;
    for (int i = 0; i < flips; ++i) {
      // Not the padding behind the header, which is a sixth to a third of these bags.
      const std::size_t at = random() % (bag.size() - 4000);
      bag[at < 100 ? at : at + 4000] = static_cast<char>(random());
    }
    WriteFile(path, bag);
    try {
      found += ReadBag(path).size();
    } catch (const InputError&) {
    }
  }
  EXPECT_LT(g_largest_allocation, 3U << 20U);
  // Most messages survive: damage costs what stands behind it in its chunk, not what follows.
  EXPECT_GT(found, 1000 * FixtureMessages().size() * 8 / 10);
}

TEST_P(DamagedBag, ThatWasNeverClosedGivesAllMessages) {
  const auto path = Copy();
  std::string bag = ReadFile(path);
  bag.resize(RecordsOf(path, ros1::Op::kIndexData).back().second);
  const std::size_t index_pos = bag.find("index_pos=") + 10;
  bag.replace(index_pos, 8, 8, '\0');
  WriteFile(path, bag);
  Ros1BagReader reader(path);
  EXPECT_EQ(reader.topics()[0].messages, 20U);
  EXPECT_EQ(reader.topics()[1].messages, 40U);
  EXPECT_EQ(ReadRest(&reader), FixtureMessages());
  EXPECT_TRUE(reader.report().damaged);
  EXPECT_EQ(reader.report().bytes_lost, 0U);
  EXPECT_THAT(
      reader.report().warnings,
      ElementsAre(HasSubstr("a.bag: it was never closed and has no index; a scan found 60")));

  // Nor do the indices behind the chunks matter.
  std::string chunks = bag.substr(0, 13 + 4096);
  for (const auto& [begin, end] : RecordsOf(path, ros1::Op::kChunk)) {
    chunks += bag.substr(begin, end - begin);
  }
  WriteFile(path, chunks);
  EXPECT_EQ(ReadBag(path), FixtureMessages());
}

TEST_P(DamagedBag, WithAHoleGivesWhatIsBeforeAndBehindIt) {
  const auto path = Copy();
  std::string bag = ReadFile(path);
  const auto [begin, end] = RecordsOf(path, ros1::Op::kChunk)[1];
  const RandomAccessFile file(path);
  ros1::Chunk in_hole_chunk;
  ros1::ChunkReader(file).Read(begin, end, &in_hole_chunk);
  const std::size_t in_hole = in_hole_chunk.messages.size();
  ASSERT_GT(in_hole, 0U);
  bag.replace(begin, end - begin, end - begin, '\0');
  for (const bool indexed : {true, false}) {
    if (!indexed) bag.replace(bag.find("index_pos=") + 10, 8, 8, '\0');
    WriteFile(path, bag);
    Ros1BagReader reader(path);
    EXPECT_EQ(ReadRest(&reader).size(), FixtureMessages().size() - in_hole);
    EXPECT_GE(reader.report().bytes_lost, end - begin);
    EXPECT_THAT(reader.report().warnings,
                Contains(HasSubstr("a.bag: at byte " + std::to_string(begin))));
  }
}

TEST_P(DamagedBag, WhoseTopicsAreDefinedInABrokenChunkHasTheirOtherMessages) {
  const auto path = Copy();
  std::string bag = ReadFile(path);
  const auto [begin, end] = RecordsOf(path, ros1::Op::kChunk)[0];
  const RandomAccessFile file(path);
  ros1::Chunk first;
  ros1::ChunkReader(file).Read(begin, end, &first);
  ASSERT_FALSE(first.connections.empty());
  const std::size_t lost = first.messages.size();
  // A part of it is gone, so that the index at the end is not where it should be.
  bag.erase(begin + 10, end - begin - 20);
  WriteFile(path, bag);
  Ros1BagReader reader(path);
  EXPECT_EQ(ReadRest(&reader).size(), FixtureMessages().size() - lost);
  std::uint64_t counted = 0;
  for (const Topic& topic : reader.topics()) counted += topic.messages;
  EXPECT_EQ(counted, FixtureMessages().size() - lost);
  EXPECT_TRUE(reader.report().damaged);
}

INSTANTIATE_TEST_SUITE_P(All, DamagedBag, ::testing::Values("none.bag", "bz2.bag", "lz4.bag"),
                         [](const auto& param) {
                           return std::filesystem::path(param.param).stem().string();
                         });

TEST(PlainBag, CutAnywhereGivesExactlyTheMessagesThatAreWhole) {
  const TempFolder folder;
  const auto path = folder / "a.bag";
  const std::string bag = ReadFile(Fixture("none.bag"));
  std::vector<std::size_t> ends;
  for (const BagMessage& message : FixtureMessages()) {
    const auto nsec = static_cast<std::uint32_t>(message.recorded_ns % 1'000'000'000);
    std::string stamp("time=\0\x10\x5e\x5f", 9);  // 1600000000
    stamp.append(reinterpret_cast<const char*>(&nsec), sizeof(nsec));
    ends.push_back(bag.find(stamp) + stamp.size() + sizeof(std::uint32_t) + message.bytes.size());
  }
  WriteFile(path, bag);
  for (std::size_t cut = bag.size() - 1; cut > 5000; cut -= 7) {
    std::filesystem::resize_file(path, cut);
    const auto whole = static_cast<std::size_t>(
        std::count_if(ends.begin(), ends.end(), [&](std::size_t end) { return end <= cut; }));
    ASSERT_EQ(CountUnharmed(path, FixtureMessages()), whole) << "cut at " << cut;
  }
}

TEST(PlainBag, SaysWhereItIsCutAndHowMuchIsLost) {
  const TempFolder folder;
  const auto path = folder / "a.bag";
  WriteFile(path, ReadFile(Fixture("none.bag")));
  const auto last = RecordsOf(path, ros1::Op::kChunk).back();
  std::filesystem::resize_file(path, last.second - 1);
  Ros1BagReader reader(path);
  EXPECT_EQ(ReadRest(&reader).size(), 59U);
  EXPECT_TRUE(reader.report().damaged);
  // The record of the last message but its last byte; 46 bytes of it stand before the message.
  const std::size_t lost = 46 + FixtureMessages().back().bytes.size() - 1;
  EXPECT_EQ(reader.report().bytes_lost, lost);
  EXPECT_THAT(reader.report().warnings,
              ElementsAre(HasSubstr("the file ends at byte " + std::to_string(last.second - 1)),
                          HasSubstr("at byte " + std::to_string(last.first) +
                                    ": this chunk is not complete; " + std::to_string(lost) +
                                    " bytes lost")));
}

TEST(PlainBag, WhoseRecorderCrashedInAChunkGivesTheMessagesInIt) {
  const TempFolder folder;
  const auto path = folder / "a.bag.active";
  std::string bag = ReadFile(Fixture("none.bag"));
  WriteFile(path, bag);
  // The recorder fills in both lengths of a chunk when it has ended.
  const auto [begin, end] = RecordsOf(path, ros1::Op::kChunk).back();
  const std::size_t size_field = bag.find("size=", begin) + 5;
  bag.replace(size_field, 8, 8, '\0');  // And the data length behind it.
  bag.replace(bag.find("index_pos=") + 10, 8, 8, '\0');
  WriteFile(path, bag.substr(0, end));
  Ros1BagReader reader(path);
  EXPECT_EQ(ReadRest(&reader), FixtureMessages());
  EXPECT_TRUE(reader.report().damaged);
  EXPECT_EQ(reader.report().bytes_lost, 0U);
}

TEST(PlainBag, WithAWrongLengthOfAChunkLosesNothing) {
  const TempFolder folder;
  const auto path = folder / "a.bag";
  const std::string bag = ReadFile(Fixture("none.bag"));
  WriteFile(path, bag);
  for (const auto& [begin, end] : RecordsOf(path, ros1::Op::kChunk)) {
    for (const std::uint32_t length : {1U, 100U, 5000U, 0x7fffffffU, 0xffffffffU}) {
      std::string broken = bag;
      std::memcpy(&broken[broken.find("size=", begin) + 9], &length, sizeof(length));
      for (const bool indexed : {true, false}) {
        if (!indexed) broken.replace(broken.find("index_pos=") + 10, 8, 8, '\0');
        WriteFile(path, broken);
        Ros1BagReader reader(path);
        EXPECT_EQ(ReadRest(&reader), FixtureMessages()) << length << (indexed ? " indexed" : "");
        EXPECT_TRUE(reader.report().damaged);
      }
    }
  }
}

class CutChunk : public ::testing::TestWithParam<BagCompression> {};

TEST_P(CutChunk, GivesTheBlocksInFrontOfTheCut) {
  const TempFolder folder;
  const auto path = folder / "a.bag";
  Ros1BagWriter writer(path, {GetParam(), 4U << 20U});
  std::mt19937 random(3);
  constexpr int kCount = 300;
  for (int i = 0; i < kCount; ++i) {
    std::string noise(10'000, '\0');
    for (char& c : noise) c = static_cast<char>(random());
    writer.Write({"/a", kString}, i, noise);
  }
  writer.Close();
  ASSERT_THAT(RecordsOf(path, ros1::Op::kChunk), SizeIs(1));
  const std::vector<BagMessage> whole = ReadBag(path);
  ASSERT_THAT(whole, SizeIs(kCount));
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  Ros1BagReader reader(path);
  const std::vector<BagMessage> left = ReadRest(&reader);
  // The blocks of bz2 are of 900 kB.
  EXPECT_GE(left.size(), GetParam() == BagCompression::kBz2 ? 50U : 140U);
  EXPECT_LE(left.size(), 150U);
  EXPECT_TRUE(std::equal(left.begin(), left.end(), whole.begin()));
  EXPECT_EQ(reader.topics()[0].messages, left.size());
  EXPECT_GT(reader.report().bytes_lost, 0U);
  EXPECT_LT(reader.report().bytes_lost, 1'000'000U);
}

INSTANTIATE_TEST_SUITE_P(All, CutChunk,
                         ::testing::Values(BagCompression::kNone, BagCompression::kBz2,
                                           BagCompression::kLz4));

}  // namespace
}  // namespace trajlo::testing
