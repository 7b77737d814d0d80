// SPDX-License-Identifier: MIT
// What the command does when the machine does not let it end: a full disk, too little memory, a
// signal. What was computed until then is there.
#include <sys/stat.h>

#include <csignal>

#include "tests/apps/trajlo_run_testing.h"
#include "tests/support/sanitizers.h"

namespace trajlo::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

TEST_F(TrajloRunTest, AnEarlierResultIsFiveUnlessOverwritten) {
  RoomRecording().Write(input());
  ASSERT_EQ(Run().exit_code, 0);
  const std::string before = ReadFile(Result("run.json"));
  const Outcome outcome = Run();
  EXPECT_EQ(outcome.exit_code, 5);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("earlier result"), HasSubstr("--overwrite")));
  EXPECT_EQ(ReadFile(Result("run.json")), before);
  EXPECT_EQ(Run({"--overwrite"}).exit_code, 0);
}

TEST_F(TrajloRunTest, AnOutputThatIsNoFolderIsFive) {
  RoomRecording().Write(input());
  for (const char* path : {"/dev/full", "/dev/null/below"}) {
    const Outcome outcome = Call({"--input=" + input(), std::string("--output=") + path});
    EXPECT_EQ(outcome.exit_code, 5) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(path));
  }
}

TEST_F(TrajloRunTest, AFullDiskIsFiveWhicheverFileMeetsIt) {
  RoomRecording().Write(input());
  for (const char* name : {"trajectory.tum", "windows.csv", "map.ply", "config.yaml", "run.json"}) {
    fs::remove_all(output());
    fs::create_directories(output());
    fs::create_symlink("/dev/full", Result(name));
    const Outcome outcome = Run({"--overwrite"});
    EXPECT_EQ(outcome.exit_code, 5) << name;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr(name), HasSubstr("No space left"))) << name;
    EXPECT_THAT(outcome.out, Not(HasSubstr("0 of 0 scans"))) << name;
    if (std::string(name) == "map.ply") {
      EXPECT_THAT(outcome.out, HasSubstr("12 of 12 scans"));
    }
  }
}

TEST_F(TrajloRunTest, AKilledRunIsSaidToBeUnfinished) {
  RoomRecording().Write(input());
  fs::create_directories(output());
  WriteFile(Result("run.json"), R"({"exit": {"code": null, "reason": "running"}})");
  const Outcome outcome = Run();
  EXPECT_EQ(outcome.exit_code, 5);
  EXPECT_THAT(outcome.err, HasSubstr("holds a result that did not finish (run.json)"));
  WriteFile(Result("run.json"), R"({"exit": {"code": 0, "reason": "ok"}})");
  EXPECT_THAT(Run().err, HasSubstr("holds an earlier result (run.json)"));
}

TEST_F(TrajloRunTest, AClosedPipeEndsAListSilently) {
  const std::string err = (temp_ / "err").string();
  const std::string command = std::string("bash -c 'set -o pipefail; ") + TRAJLO_RUN +
                              " --show_config 2>" + err + " | head -1 >/dev/null'";
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(ReadFile(err), "");
}

TEST_F(TrajloRunTest, APipeThatNobodyReadsIsFiveAndDoesNotHang) {
  RoomRecording().Write(input());
  fs::create_directories(output());
  ASSERT_EQ(mkfifo(Result("trajectory.tum").c_str(), 0600), 0);
  const Outcome outcome = Run({"--overwrite"});
  EXPECT_EQ(outcome.exit_code, 5);
  EXPECT_THAT(outcome.err, HasSubstr("is a pipe that nobody reads"));
}

TEST_F(TrajloRunTest, TooLittleMemoryIsSixWithASentence) {
  if (testing::kSanitized) GTEST_SKIP() << "sanitizers reserve more memory than there is";
  RoomRecording().Write(input());
  int failed = 0;
  for (const char* kilobytes : {"32000", "40000", "50000", "64000", "80000", "120000"}) {
    const Outcome outcome = CallProgram(
        "/bin/bash", {"-c", std::string("ulimit -v ") + kilobytes + R"(; exec "$0" "$@")",
                      TRAJLO_RUN, input(), "-o", output(), "--overwrite"});
    // 3: too little for some scans only. 127: too little to load the program.
    EXPECT_THAT(outcome.exit_code, ::testing::AnyOf(0, 3, 6, 127)) << kilobytes << outcome.err;
    if (outcome.exit_code != 6) continue;
    ++failed;
    EXPECT_THAT(outcome.err,
                ::testing::AnyOf(HasSubstr("there is not enough memory"),
                                 HasSubstr("no thread could be started"), HasSubstr("failed: ")));
  }
  EXPECT_GT(failed, 0);
}

TEST_F(TrajloRunTest, ADiskThatFillsUpLaterIsFiveAndKeepsWhatWasWritten) {
  RoomRecording room;
  room.scans = 30;
  room.Write(input());
  // config.yaml needs about 10 kB; windows.csv outgrows the bound after some windows.
  const Outcome outcome = Call({"--input=" + input(), "--output=" + output()}, 16'000);
  EXPECT_EQ(outcome.exit_code, 5) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("too large"));
  EXPECT_EQ(RunJson()["exit"]["code"], 5);
  EXPECT_GT(Trajectory().size(), 3u);
}

TEST_F(TrajloRunTest, OnADiskThatIsFullTheSummaryStillSaysSo) {
  RoomRecording room;
  room.scans = 30;
  room.Write(input());
  fs::create_directories(output());
  // 40k is too little from the start; of 96k, windows.csv and trajectory.tum want more than is
  // left.
  for (const char* size : {"40k", "96k"}) {
    const Outcome outcome =
        CallProgram("/usr/bin/env", {"unshare", "--map-root-user", "--mount", "/bin/bash", "-c",
                                     R"(mount -t tmpfs -o size="$1" tmpfs "$2" || exit 99
            "$0" "$3" -o "$2/result" --quiet; code=$?; cat "$2/result/run.json"; exit $code)",
                                     TRAJLO_RUN, size, output(), input()});
    const bool has_disk = outcome.exit_code != 1 && outcome.exit_code != 99;
    if (!has_disk) GTEST_SKIP() << "no disk can be made: " << outcome.err;
    EXPECT_EQ(outcome.exit_code, 5) << size;
    EXPECT_THAT(outcome.err, HasSubstr("No space left")) << size;
    const auto json = nlohmann::json::parse(outcome.out, nullptr, false);
    ASSERT_TRUE(json.is_object()) << size << outcome.out;
    EXPECT_EQ(json["exit"]["reason"], "output_not_writable") << size;
    EXPECT_EQ(json["exit"]["code"], 5) << size;
  }
}

/// A run that is under way: some poses are written, and many scans are left.
class InterruptedRunTest : public TrajloRunTest {
 protected:
  void SetUp() override {
    RoomRecording room;
    room.scans = 1;
    room.Write(input());
    std::ofstream stamps(temp_ / "in/timestamps.txt");
    for (int i = 0; i < kScans; ++i) {
      stamps << std::to_string(RoomRecording::kStart + 0.1 * i) << "\n";
      if (i > 0)
        fs::create_hard_link(RoomRecording::File(input(), 0), RoomRecording::File(input(), i));
    }
    stamps.close();
    process_ = std::make_unique<Process>(
        std::vector<std::string>{TRAJLO_RUN, "--input=" + input(), "--output=" + output()});
    while (PosesWritten() < 10 && !process_->HasEnded()) usleep(1000);
  }

  std::ptrdiff_t PosesWritten() const {
    const std::string text = ReadFile(Result("trajectory.tum"));
    return std::count(text.begin(), text.end(), '\n');
  }

  static constexpr int kScans = 1000;
  std::unique_ptr<Process> process_;
};

TEST_F(InterruptedRunTest, SignalsEndTheRunWithAllFilesAnd130) {
  process_->Signal(SIGINT);
  EXPECT_EQ(process_->Wait(), 130) << process_->Err();
  EXPECT_EQ(RunJson()["exit"]["reason"], "interrupted");
  EXPECT_EQ(RunJson()["result"]["poses_written"], Trajectory().size());
  EXPECT_LT(RunJson()["input"]["scans"]["read"], kScans);
  EXPECT_TRUE(fs::exists(Result("map.ply")));
}

TEST_F(InterruptedRunTest, TerminationIsTheSame) {
  process_->Signal(SIGTERM);
  EXPECT_EQ(process_->Wait(), 130);
  EXPECT_GE(Trajectory().size(), 10u);
}

TEST_F(InterruptedRunTest, AKilledRunLeavesAReadablePrefixThatSaysSo) {
  process_->Signal(SIGKILL);
  EXPECT_EQ(process_->Wait(), -SIGKILL);
  EXPECT_GE(Trajectory().size(), 10u);
  const std::string text = ReadFile(Result("trajectory.tum"));
  EXPECT_EQ(text.back(), '\n');
  EXPECT_EQ(RunJson()["exit"]["reason"], "running");
  EXPECT_TRUE(RunJson()["exit"]["code"].is_null());
  EXPECT_EQ(Run().exit_code, 5);  // Nor is it replaced without --overwrite.
}

}  // namespace
}  // namespace trajlo::testing
