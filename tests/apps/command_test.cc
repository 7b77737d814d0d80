// SPDX-License-Identifier: MIT
#include "apps/command.h"

#include <gflags/gflags.h>
#include <gmock/gmock.h>

#include <csignal>
#include <new>
#include <stdexcept>

#include "apps/interrupt.h"
#include "apps/usage_error.h"
#include "core/config/config_error.h"
#include "core/io/errors.h"

DEFINE_bool(loud, false, "a flag of the command under test");

namespace trajlo {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

using Body = std::function<ExitCode(const CommandLine&)>;

struct Result {
  int exit_code;
  std::string out, err;
};

Result RunWith(std::vector<std::string> words, const Body& run) {
  words.insert(words.begin(), "command_test");
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  // The name of this file: its flags are those of the command.
  const int exit_code =
      RunCommand({"command_test", "examples\n", run}, static_cast<int>(words.size()), argv.data());
  return {exit_code, ::testing::internal::GetCapturedStdout(),
          ::testing::internal::GetCapturedStderr()};
}

TEST(RunCommand, HandsOverArgumentsWithoutFlagsAndReturnsTheCode) {
  CommandLine line;
  const Result result = RunWith({"a", "--loud=true", "b"}, [&](const CommandLine& given) {
    line = given;
    return ExitCode::kLost;
  });
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_TRUE(FLAGS_loud);
  EXPECT_THAT(line.arguments, ElementsAre("a", "b"));
  EXPECT_THAT(line.words, ElementsAre("command_test", "a", "--loud=true", "b"));
  EXPECT_THROW(RequireNoArguments(line), UsageError);
}

TEST(RunCommand, RefusesWordsThatNoResultCouldName) {
  const Body run = [](const CommandLine&) { return ExitCode::kOk; };
  for (const char* word : {"fl\xc3\xbc"
                           "ge",
                           "\xe2\x80\xa6", "\xf0\x9f\x9a\x80.bag"}) {
    EXPECT_EQ(RunWith({word}, run).exit_code, 0) << word;
  }
  for (const char* word : {"bad\xff\xfename", "\xfc", "cut\xc3", "\xc0\xaf", "\xed\xa0\x80"}) {
    const Result result = RunWith({word}, run);
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.err, HasSubstr("is not UTF-8"));
  }
  EXPECT_THAT(RunWith({"bad\xff"}, run).err, HasSubstr("'bad\\xff'"));
}

TEST(RunCommand, AnswersHelpWithoutRunning) {
  const Body run = [](const CommandLine&) { return ExitCode::kLost; };
  for (const char* help : {"--help", "-help", "-h"}) {
    const Result result = RunWith({"a", help}, run);
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.out, "examples\n");
  }
}

TEST(RunCommand, SaysWhatWasThrownAndReturnsItsCode) {
  const auto thrown = [](const auto& error) {
    return RunWith({}, [&](const CommandLine&) -> ExitCode { throw error; });
  };
  const Result usage = thrown(UsageError("--x: no such thing"));
  EXPECT_EQ(usage.exit_code, 1);
  EXPECT_THAT(usage.err, AllOf(HasSubstr("command_test: --x: no such thing\n"),
                               HasSubstr("(command_test --help shows examples)")));
  EXPECT_EQ(thrown(ConfigError("a.yaml:1:1", "unknown key")).exit_code, 1);
  const Result input = thrown(InputError("a.bag", "is no bag", "Look again."));
  EXPECT_EQ(input.exit_code, 2);
  EXPECT_EQ(input.err, "command_test: a.bag: is no bag\n  Look again.\n");
  EXPECT_EQ(thrown(OutputError("out", "disk full")).exit_code, 5);
  const Result memory = thrown(std::bad_alloc());
  EXPECT_EQ(memory.exit_code, 6);
  EXPECT_EQ(memory.err, "command_test: there is not enough memory\n");
  const Result defect = thrown(std::out_of_range("vector::at"));
  EXPECT_EQ(defect.exit_code, 6);
  EXPECT_EQ(defect.err, "command_test: failed: vector::at\n");
}

TEST(RunCommand, AGracefulCommandHandlesSignalsBeforeItReadsItsWords) {
  Command command{"command_test", "examples\n", [](const CommandLine&) { return ExitCode::kOk; }};
  command.ends_gracefully = true;
  std::string words[] = {"command_test", "--nonsense"};
  char* argv[] = {words[0].data(), words[1].data(), nullptr};
  ASSERT_EQ(std::signal(SIGTERM, SIG_DFL), SIG_DFL);
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(RunCommand(command, 2, argv), 1);
  ::testing::internal::GetCapturedStderr();
  std::raise(SIGTERM);  // Would end the test.
  EXPECT_TRUE(HandleInterrupts());
}

TEST(RunCommand, WordsBehindTwoDashesAreNoFlags) {
  CommandLine line;
  const Result result = RunWith({"--", "--help"}, [&](const CommandLine& given) {
    line = given;
    return ExitCode::kOk;
  });
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(line.arguments, ElementsAre("--help"));
}

}  // namespace
}  // namespace trajlo
