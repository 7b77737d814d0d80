// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>

#include "core/io/errors.h"
#include "core/io/ros1/ros1_bag_writer.h"
#include "tests/core/io/ros1/ros1_testing.h"
#include "tests/support/temp_folder.h"

namespace trajlo::testing {
namespace {

using ::testing::_;
using ::testing::ElementsAre;
using ::testing::FieldsAre;
using ::testing::HasSubstr;

const MessageDescription kPoints{"sensor_msgs/PointCloud2", "1158d486dd51d683ce2f1be655c3c181",
                                 "uint32 height\n"};
const MessageDescription kPose{"geometry_msgs/PoseStamped", "d3812c3cbc69362b77dc0b19b345f8f5", ""};

class Written : public ::testing::TestWithParam<BagCompression> {};

TEST_P(Written, BagReadsBackToTheLastByte) {
  const TempFolder folder;
  Ros1BagOptions options;
  options.compression = GetParam();
  options.chunk_bytes = 2500;
  Ros1BagWriter writer(folder / "a.bag", options);
  std::vector<BagMessage> messages = FixtureMessages();
  std::swap(messages[5], messages[50]);
  for (const BagMessage& message : messages) {
    writer.Write({message.topic, message.topic == "/pose" ? kPose : kPoints}, message.recorded_ns,
                 message.bytes);
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "a.bag"));
  writer.Close();
  EXPECT_FALSE(std::filesystem::exists(folder / "a.bag.part"));
  Ros1BagReader reader(folder / "a.bag");
  EXPECT_THAT(
      reader.topics(),
      ElementsAre(
          FieldsAre("/points", "sensor_msgs/PointCloud2", Encoding::kRos1, 20U, "", _, _, _),
          FieldsAre("/pose", "geometry_msgs/PoseStamped", Encoding::kRos1, 40U, "", _, _, _)));
  EXPECT_EQ(ReadRest(&reader), FixtureMessages());
  EXPECT_FALSE(reader.report().damaged);
}

INSTANTIATE_TEST_SUITE_P(All, Written,
                         ::testing::Values(BagCompression::kNone, BagCompression::kBz2,
                                           BagCompression::kLz4));

TEST(Writer, KeepsEmptyMessagesAndTheFirstAndTheLastStampOfTheFormat) {
  const TempFolder folder;
  constexpr std::int64_t kLast_ns = 4294967295999999999;
  Ros1BagWriter writer(folder / "a.bag");
  writer.Write({"/pose", kPose}, kLast_ns, "");
  writer.Write({"/pose", kPose}, 0, "x");
  EXPECT_THROW(writer.Write({"/pose", kPose}, kLast_ns + 1, "x"), OutputError);
  EXPECT_THROW(writer.Write({"/pose", kPose}, -1, "x"), OutputError);
  writer.Close();
  EXPECT_THAT(ReadBag(folder / "a.bag"),
              ElementsAre(FieldsAre("/pose", 0, "x"), FieldsAre("/pose", kLast_ns, "")));
}

TEST(Writer, ABagWithoutMessagesIsABagToo) {
  const TempFolder folder;
  Ros1BagWriter(folder / "a.bag").Close();
  Ros1BagReader reader(folder / "a.bag");
  EXPECT_TRUE(reader.topics().empty());
  EXPECT_TRUE(ReadRest(&reader).empty());
  EXPECT_FALSE(reader.report().damaged);
}

TEST(Writer, LeavesNothingWithoutClose) {
  const TempFolder folder;
  { Ros1BagWriter(folder / "a.bag").Write({"/pose", kPose}, 1, "x"); }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Writer, RefusesToWriteAfterClose) {
  const TempFolder folder;
  Ros1BagWriter writer(folder / "a.bag");
  writer.Close();
  writer.Close();
  EXPECT_THROW(writer.Write({"/pose", kPose}, 1, "x"), OutputError);
}

TEST(Writer, DoesNotReplaceABagWithoutBeingToldSo) {
  const TempFolder folder;
  WriteFile(folder / "a.bag", "precious");
  EXPECT_THROW(Ros1BagWriter(folder / "a.bag"), OutputError);
  EXPECT_EQ(ReadFile(folder / "a.bag"), "precious");
  Ros1BagOptions options;
  options.if_exists = IfExists::kReplace;
  Ros1BagWriter(folder / "a.bag", options).Close();
  EXPECT_TRUE(ReadBag(folder / "a.bag").empty());
}

TEST(Writer, AFullDiskIsAnError) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full on this system";
  EXPECT_THROW(Ros1BagWriter("/dev/full"), OutputError);
}

TEST(Writer, ADiskThatFillsUpIsAnErrorAndLeavesNothing) {
  const TempFolder folder;
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit limit{100'000, before.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &limit);
  {
    Ros1BagWriter writer(folder / "a.bag");
    writer.Write({"/pose", kPose}, 1, std::string(200'000, 'x'));
    EXPECT_THROW(writer.Close(), OutputError);
  }
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Writer, AMissingFolderIsAnErrorThatNamesTheFile) {
  const TempFolder folder;
  try {
    const Ros1BagWriter writer(folder / "no/a.bag");
    FAIL();
  } catch (const OutputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no/a.bag"));
  }
}

TEST(Writer, AFolderThatIsNotWritableIsAnError) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const TempFolder folder;
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_read);
  EXPECT_THROW(Ros1BagWriter(folder / "a.bag"), OutputError);
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_all);
}

}  // namespace
}  // namespace trajlo::testing
