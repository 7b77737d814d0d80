// SPDX-License-Identifier: MIT
#include "core/io/conversion/extract_poses.h"

#include <gmock/gmock.h>

#include "core/io/conversion/open_bag.h"
#include "core/io/errors.h"
#include "core/io/messages/message_writer.h"
#include "tests/support/temp_folder.h"

namespace trajlo::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::int64_t kStartNs = 1'700'000'000'123'456'789;
constexpr std::int64_t kPeriodNs = 100'000'000;

/// Poses of one topic, recorded a period apart whatever their stamps.
void WritePoses(const std::filesystem::path& path, const std::vector<StampedPose>& poses) {
  const auto bag = OpenBag(path);
  const TopicDescription topic{"/truth", PoseStampedDescription()};
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::int64_t recorded_ns = kStartNs + static_cast<std::int64_t>(i) * kPeriodNs;
    bag->Write(
        topic, recorded_ns,
        WritePoseStamped({0, poses[i].t_ns, "world"}, poses[i].T_world_body, bag->encoding()));
  }
  bag->Close();
}

/// Poses with these stamps, each where it was recorded along x.
std::vector<StampedPose> PosesAt(const std::vector<std::int64_t>& t_ns) {
  std::vector<StampedPose> poses;
  for (const std::int64_t t : t_ns) {
    const auto x_m = static_cast<double>(poses.size());
    poses.push_back({t, SE3(Eigen::Quaterniond(0.8, 0.0, 0.0, 0.6), {x_m, 0.0, 0.0})});
  }
  return poses;
}

std::vector<std::int64_t> StampsOf(const ExtractedPoses& extracted) {
  std::vector<std::int64_t> t_ns;
  for (const StampedPose& pose : extracted.poses) t_ns.push_back(pose.t_ns);
  return t_ns;
}

TEST(ExtractPoses, GivesThePosesOfATopic) {
  const TempFolder folder;
  WritePoses(folder / "a.bag", PosesAt({kStartNs, kStartNs + 1}));
  const ExtractedPoses extracted = ExtractPoses(folder / "a.bag", "/truth");
  EXPECT_THAT(StampsOf(extracted), ElementsAre(kStartNs, kStartNs + 1));
  EXPECT_EQ(extracted.poses[1].T_world_body.t.x(), 1.0);
  EXPECT_EQ(extracted.unreadable, 0u);
  EXPECT_THAT(extracted.report.warnings, ::testing::IsEmpty());
  try {
    ExtractPoses(folder / "a.bag", "/points");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("/truth (geometry_msgs/PoseStamped, 2 messages)"));
  }
}

TEST(ExtractPoses, ReadsAFolderOfBags) {
  const TempFolder folder;
  WritePoses(folder / "part_10.bag", PosesAt({kStartNs + 2, kStartNs + 3}));
  WritePoses(folder / "part_9.bag", PosesAt({kStartNs, kStartNs + 1}));
  EXPECT_EQ(ExtractPoses(folder.path(), "/truth").poses.size(), 4u);
}

TEST(ExtractPoses, AreInTheOrderOfTimeAndEachStampCountsOnce) {
  const TempFolder folder;
  WritePoses(folder / "a.bag",
             PosesAt({kStartNs + 5, kStartNs + 1, kStartNs + 3, kStartNs + 3, kStartNs + 2}));
  const ExtractedPoses extracted = ExtractPoses(folder / "a.bag", "/truth");
  EXPECT_THAT(StampsOf(extracted),
              ElementsAre(kStartNs + 1, kStartNs + 2, kStartNs + 3, kStartNs + 5));
  EXPECT_EQ(extracted.poses[2].T_world_body.t.x(), 2.0);
  EXPECT_EQ(extracted.unreadable, 0u);
  EXPECT_THAT(extracted.report.warnings,
              ElementsAre(HasSubstr("/truth: 2 stamps are earlier than the one before"),
                          HasSubstr("1 stamp repeats an earlier one, 1 of them with another")));
  EXPECT_EQ(extracted.contradicted, 1u);

  std::vector<StampedPose> twice = PosesAt({kStartNs});
  twice.push_back(twice.front());
  WritePoses(folder / "twice.bag", twice);
  const ExtractedPoses same = ExtractPoses(folder / "twice.bag", "/truth");
  EXPECT_EQ(same.contradicted, 0u);
  EXPECT_THAT(same.report.warnings, ElementsAre(HasSubstr("earlier one; what was recorded first")));
}

TEST(ExtractPoses, StampsThatNobodyFilledAreTheTimesOfRecording) {
  const TempFolder folder;
  WritePoses(folder / "none.bag", PosesAt({0, 0, 0}));
  const ExtractedPoses none = ExtractPoses(folder / "none.bag", "/truth");
  EXPECT_THAT(StampsOf(none),
              ElementsAre(kStartNs, kStartNs + kPeriodNs, kStartNs + 2 * kPeriodNs));
  EXPECT_THAT(none.report.warnings, ElementsAre(HasSubstr("times of recording stand for them")));

  WritePoses(folder / "some.bag", PosesAt({kStartNs, 0, kStartNs + 2}));
  const ExtractedPoses some = ExtractPoses(folder / "some.bag", "/truth");
  EXPECT_THAT(StampsOf(some), ElementsAre(kStartNs, kStartNs + 2));
  EXPECT_EQ(some.unreadable, 1u);
  EXPECT_THAT(some.report.warnings, ElementsAre(HasSubstr("1 pose has the stamp zero")));

  WritePoses(folder / "simulated.bag", PosesAt({0, 10'000'000, 20'000'000}));
  const ExtractedPoses simulated = ExtractPoses(folder / "simulated.bag", "/truth");
  EXPECT_EQ(simulated.poses.size(), 3u);
  EXPECT_THAT(simulated.report.warnings, ::testing::IsEmpty());
}

TEST(ExtractPoses, AZeroQuaternionIsARotationOnlyWhereNoPoseHasOne) {
  const TempFolder folder;
  std::vector<StampedPose> poses = PosesAt({kStartNs, kStartNs + 1, kStartNs + 2});
  poses[1].T_world_body.q.coeffs().setZero();
  WritePoses(folder / "some.bag", poses);
  const ExtractedPoses some = ExtractPoses(folder / "some.bag", "/truth");
  EXPECT_THAT(StampsOf(some), ElementsAre(kStartNs, kStartNs + 2));
  EXPECT_EQ(some.unreadable, 1u);
  EXPECT_THAT(some.report.warnings, ElementsAre(HasSubstr("1 pose has a zero quaternion")));

  for (StampedPose& pose : poses) pose.T_world_body.q.coeffs().setZero();
  WritePoses(folder / "all.bag", poses);
  const ExtractedPoses all = ExtractPoses(folder / "all.bag", "/truth");
  EXPECT_EQ(all.poses.size(), 3u);
  EXPECT_EQ(all.unreadable, 0u);
  EXPECT_THAT(all.report.warnings, ElementsAre(HasSubstr("positions without rotations")));
}

}  // namespace
}  // namespace trajlo::testing
