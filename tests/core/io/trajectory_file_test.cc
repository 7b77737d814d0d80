// SPDX-License-Identifier: MIT
#include "core/io/trajectory_file.h"

#include <gmock/gmock.h>

#include "core/io/errors.h"
#include "tests/core/io/io_testing.h"

namespace trajlo {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class TrajectoryFileTest : public ::testing::Test {
 protected:
  TrajectoryFile Read(const std::string& text, TrajectoryFormat format = TrajectoryFormat::kAuto) {
    warnings_.clear();
    return ReadTrajectory(folder_.Write("a.txt", text), format, &warnings_);
  }
  std::string ErrorOf(const std::string& text) {
    try {
      Read(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  TempFolder folder_;
  std::vector<std::string> warnings_;
};

TEST_F(TrajectoryFileTest, TheFormatIsToldByTheFirstLine) {
  const TrajectoryFile tum = Read("\xEF\xBB\xBF# stamp ...\r\n\r\n 1.5\t1 2 3 0 0 0 2 \r\n");
  EXPECT_EQ(tum.format, TrajectoryFormat::kTum);
  EXPECT_THAT(tum.t_ns, ElementsAre(1'500'000'000));
  const TrajectoryFile kitti = Read("1 0 0 4 0 1 0 5 0 0 1 6  \n");
  EXPECT_EQ(kitti.format, TrajectoryFormat::kKitti);
  EXPECT_THAT(kitti.t_ns, IsEmpty());
  EXPECT_EQ(kitti.T_world_body[0].translation(), Eigen::Vector3d(4, 5, 6));
  const TrajectoryFile euroc =
      Read("#timestamp, p, q\n1403715524907143168, 1, 2, 3, 0.5, 0.5, 0.5, 0.5, 9, 9\n");
  EXPECT_EQ(euroc.format, TrajectoryFormat::kEuroc);
  EXPECT_THAT(euroc.t_ns, ElementsAre(1403715524907143168));
}

TEST_F(TrajectoryFileTest, EurocHasTheScalarFirstAndTumHasItLast) {
  Eigen::Matrix3d quarter_about_z;
  quarter_about_z << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const TrajectoryFile euroc = Read("timestamp,x,y,z,qw,qx,qy,qz\n5,1,2,3,1,0,0,1\n");
  EXPECT_TRUE(euroc.T_world_body[0].linear().isApprox(quarter_about_z, 1e-15));
  const TrajectoryFile tum = Read("5 1 2 3 0 0 1 1\n");
  EXPECT_TRUE(tum.T_world_body[0].linear().isApprox(quarter_about_z, 1e-15));
}

TEST_F(TrajectoryFileTest, AFormatThatIsGivenIsNotGuessed) {
  EXPECT_THROW(Read("1 0 0 4 0 1 0 5 0 0 1 6\n", TrajectoryFormat::kTum), InputError);
  EXPECT_EQ(Read("1.5,1,2,3,1,0,0,0\n", TrajectoryFormat::kEuroc).t_ns.size(), 1u);
}

TEST_F(TrajectoryFileTest, KittiRotationsAreKeptAsWrittenUnlessTheyAreFarOff) {
  EXPECT_EQ(Read("1.00001 0 0 0 0 1 0 0 0 0 1 0\n").T_world_body[0].linear()(0, 0), 1.00001);
  EXPECT_THAT(warnings_, IsEmpty());
  const TrajectoryFile projected = Read("1.001 0 0 0 0 1.001 0 0 0 0 1.001 0\n");
  EXPECT_TRUE(projected.T_world_body[0].linear().isIdentity(1e-15));
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("nearest rotations")));
  EXPECT_THAT(ErrorOf("2 0 0 0 0 1 0 0 0 0 1 0\n"), HasSubstr("no rotation"));
  EXPECT_THAT(ErrorOf("-1 0 0 0 0 1 0 0 0 0 1 0\n"), HasSubstr("no rotation"));
}

TEST_F(TrajectoryFileTest, UnusableLinesAreSkippedWhereStampsTellWhichOnes) {
  const TrajectoryFile euroc = Read("1,nan,0,0,1,0,0,0\n2,0,0,0,0,0,0,0\n3,0,0,0,1,0,0,0\n");
  EXPECT_THAT(euroc.t_ns, ElementsAre(3));
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("line 1"), HasSubstr("line 2")));
  EXPECT_THAT(ErrorOf("1 0 0 nan 0 1 0 5 0 0 1 6\n"), HasSubstr("not finite"));
}

TEST_F(TrajectoryFileTest, NumbersWhoseLengthIsInfiniteAreNoPose) {
  // Found by fuzzing: such a quaternion was normalised to zeros, such a matrix taken for a
  // rotation.
  EXPECT_THAT(Read("1 0 0 0 1e200 0 0 0\n2 0 0 0 0 0 0 1\n").t_ns, ElementsAre(2'000'000'000));
  // One that has flown off is a pose.
  EXPECT_THAT(Read("1,1e200,0,0,1,0,0,0\n3000000,0,0,0,1,0,0,0\n").t_ns, ElementsAre(1, 3000000));
  EXPECT_THAT(ErrorOf("1e200 1e200 0 0 -1e200 1e200 0 0 0 0 1 0\n"), HasSubstr("not finite"));
}

TEST_F(TrajectoryFileTest, StampsInMillisecondsAreRefused) {
  EXPECT_THAT(ErrorOf("1700000000000 0 0 0 0 0 0 1\n"), HasSubstr("ns, us or ms"));
  EXPECT_THAT(ErrorOf("1700000000000.250 0 0 0 0 0 0 1\n"), HasSubstr("ns, us or ms"));
}

TEST_F(TrajectoryFileTest, AHeadingWithTheScalarLastIsNotReadAsEurocs) {
  for (const char* heading :
       {"timestamp,tx,ty,tz,qx,qy,qz,qw", "#timestamp [ns],p_x,p_y,p_z,q_x,q_y,q_z,q_w",
        "\xEF\xBB\xBF# made by us, today\n\n # t,x,y,z,qx,qy,qz,qw"}) {
    EXPECT_THAT(ErrorOf(std::string(heading) + "\n1700000000000000000,1,2,3,0,0,0,1\n"),
                ::testing::AllOf(HasSubstr("has w last"), HasSubstr("TUM's format")))
        << heading;
  }
  for (const char* heading : {"timestamp,x,y,z,qw,qx,qy,qz",
                              "t,p_x [m],p_y [m],p_z [m],q_w [],q_x "
                              "[],q_y [],q_z [],v_x,w_x",
                              "a,b,c,d,e,f,g,h", "t,",
                              "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], "
                              "q_RS_x [], q_RS_y [], q_RS_z [], v_RS_R_x [m s^-1]"}) {
    EXPECT_EQ(Read(std::string(heading) + "\n5,1,2,3,1,0,0,0\n").t_ns.size(), 1u) << heading;
  }
}

TEST_F(TrajectoryFileTest, StampsOfACsvThatAreNoNanosecondsAreRefused) {
  const auto csv = [](const std::vector<std::string>& stamps) {
    std::string text = "timestamp,tx,ty,tz,qw,qx,qy,qz\n";
    for (const std::string& stamp : stamps) text += stamp + ",1,2,3,0,0,0,1\n";
    return text;
  };
  for (const auto& stamps : std::vector<std::vector<std::string>>{
           {"1700000000.000000000", "1700000000.001000000", "1700000000.002000000"},  // seconds
           {"1700000000.00", "1700000000.05", "1700000000.10"},
           {"0.0", "1.0", "2.0"},
           {"1700000000000.0", "1700000000050.0"},       // ms
           {"1700000000000000", "1700000000050000"}}) {  // us
    EXPECT_THAT(ErrorOf(csv(stamps)),
                ::testing::AllOf(HasSubstr("not in nanoseconds"), HasSubstr("TUM's format")))
        << stamps[1];
  }
  EXPECT_EQ(Read(csv({"1.70000000000000e+18", "1.70000000000500e+18"})).t_ns.size(), 2u);
  EXPECT_EQ(Read(csv({"0", "5000000", "5000000", "10000000"})).t_ns.size(), 4u);
}

TEST_F(TrajectoryFileTest, ALastLineThatIsCutIsLeftOut) {
  const std::string whole = "1 0 0 0 0 0 0.6 0.8\n2 0 0 0 0 0 0.6 0.8\n";
  for (const char* cut :
       {"3", "3 0 0", "3 0 0 0 0 0 0.6 0.", "3 0 0 0 0 0 0.6 0.7", "3 0 0 0 0 0 0.6"}) {
    EXPECT_THAT(Read(whole + cut).t_ns, ElementsAre(1'000'000'000, 2'000'000'000)) << cut;
    EXPECT_THAT(warnings_, ElementsAre(HasSubstr("line 3 is skipped"))) << cut;
  }
  EXPECT_EQ(Read(whole + "3 0 0 0 0 0 0.6 0.8").t_ns.size(), 3u);
  EXPECT_EQ(Read("1 0 0 0 0 0 0 2\n2 0 0 0 0 0 0 2").t_ns.size(), 2u);  // No unit, and none cut.
  EXPECT_THAT(ErrorOf("1 0 0 0 0 0 0 1\n2 0 0\n3 0 0 0 0 0 0 1\n"), HasSubstr("line 2 is not"));
  EXPECT_THAT(ErrorOf(whole + "3 0 0 0 0 0 0.6 x\n"), HasSubstr("line 3 is not"));
  EXPECT_THAT(ErrorOf(whole + "nonsense\n"), HasSubstr("line 3 is not"));
  EXPECT_THAT(ErrorOf(whole + "3 0 0\n"), HasSubstr("line 3 is not"));
}

TEST_F(TrajectoryFileTest, PositionsAloneHaveNoRotation) {
  const TrajectoryFile prism = Read("1 4 5 6\n2 7 8 9\n");
  EXPECT_EQ(prism.format, TrajectoryFormat::kTum);
  EXPECT_THAT(prism.t_ns, ElementsAre(1'000'000'000, 2'000'000'000));
  EXPECT_EQ(prism.T_world_body[1].translation(), Eigen::Vector3d(7, 8, 9));
  EXPECT_TRUE(prism.T_world_body[1].linear().isIdentity(0.0));
  EXPECT_THAT(warnings_, IsEmpty());
  EXPECT_FALSE(prism.has_rotations);
  EXPECT_FALSE(Read("1 4 5 6 0 0 0 0\n").has_rotations);
  EXPECT_TRUE(Read("1 4 5 6 0 0 0 1\n").has_rotations);
  EXPECT_THAT(ErrorOf("1 4 5 6\n2 7 8 9 0 0 0 1\n3 7 8 9\n"), HasSubstr("line 2"));
}

TEST_F(TrajectoryFileTest, AResultStandsForItsTrajectory) {
  folder_.Write("trajectory.tum", "1 0 0 0 0 0 0 1\n");
  EXPECT_EQ(ReadTrajectory(folder_.path(), TrajectoryFormat::kAuto, &warnings_).t_ns.size(), 1u);
}

TEST_F(TrajectoryFileTest, ABagIsToldFromATrajectory) {
  for (const std::string& bag : {std::string("#ROSBAG V2.0\n"), std::string("\x89MCAP0\r\n"),
                                 std::string("SQLite format 3\0", 16)}) {
    EXPECT_THAT(ErrorOf(bag),
                ::testing::AllOf(HasSubstr("this is a bag"), HasSubstr("truth.tum --poses=TOPIC")));
  }
}

TEST_F(TrajectoryFileTest, ManyWarningsAreCondensed) {
  std::string text;
  for (int i = 0; i < 100; ++i) text += std::to_string(i) + " nan 0 0 0 0 0 1\n";
  Read(text + "100 0 0 0 0 0 0 1\n");
  ASSERT_EQ(warnings_.size(), 3u);
  EXPECT_THAT(warnings_[2], HasSubstr("97 more lines"));
}

TEST_F(TrajectoryFileTest, MessagesSayWhatWasFoundAndWhatIsWanted) {
  EXPECT_THAT(ErrorOf("1 2 3\n"), ::testing::AllOf(HasSubstr("3 columns"), HasSubstr("TUM")));
  EXPECT_THAT(ErrorOf("0 1 0 0 4 0 1 0 5 0 0 1 6\n"), HasSubstr("13 columns"));
  EXPECT_THAT(ErrorOf("1005802000000 0 0 0 0 0 0 1\n"), HasSubstr("ns, us or ms"));
  EXPECT_THAT(ErrorOf("1.5,1,2,3,1,0,0,0\n"), HasSubstr("nanoseconds"));
  EXPECT_THAT(ErrorOf("1000,5 0,1 0,2 0,3 0,0 0,0 0,0 1,0\n"), HasSubstr("decimal commas"));
  EXPECT_THAT(ErrorOf("1000,5\t0 0 0 0 0 0 1\n"), HasSubstr("decimal commas"));
  EXPECT_THAT(ErrorOf("1,2 5,3,4,1,0,0,0,9\n"), HasSubstr("line 1 is not"));
  EXPECT_THAT(ErrorOf("t x y z qx qy qz qw\n1 0 0 0 0 0 0 1\n"),
              HasSubstr("begin the line with #"));
  EXPECT_THAT(ErrorOf("t x y\n1 0 0 0 0 0 0 1\n"), HasSubstr("begin the line with #"));
  EXPECT_THAT(ErrorOf("1 2 3\n"), ::testing::Not(HasSubstr("begin the line")));
  EXPECT_THAT(ErrorOf("1,2,3,4,x,6,7,8\n"), HasSubstr("line 1"));
  EXPECT_THAT(ErrorOf("# nothing\n"), HasSubstr("no poses"));
  EXPECT_THAT(ErrorOf("1 0 0 4 0 1 0 5 0 0 1 6\n1 0 0 4\n"), HasSubstr("line 2"));
}

}  // namespace
}  // namespace trajlo
