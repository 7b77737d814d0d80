// SPDX-License-Identifier: MIT
#include "apps/command.h"

#include <gflags/gflags.h>
#include <gmock/gmock.h>

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
  words.insert(words.begin(), "trajlo_some");
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  const int exit_code =
      RunCommand({"trajlo_some", "examples\n", run}, static_cast<int>(words.size()), argv.data());
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
  EXPECT_THAT(line.words, ElementsAre("trajlo_some", "a", "--loud=true", "b"));
  EXPECT_THROW(RequireNoArguments(line), UsageError);
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
  EXPECT_THAT(usage.err, AllOf(HasSubstr("trajlo_some: --x: no such thing\n"),
                               HasSubstr("(trajlo_some --help shows examples)")));
  EXPECT_EQ(thrown(ConfigError("a.yaml:1:1", "unknown key")).exit_code, 1);
  const Result input = thrown(InputError("a.bag", "is no bag", "Look again."));
  EXPECT_EQ(input.exit_code, 2);
  EXPECT_EQ(input.err, "trajlo_some: a.bag: is no bag\n  Look again.\n");
  EXPECT_EQ(thrown(OutputError("out", "disk full")).exit_code, 5);
}

}  // namespace
}  // namespace trajlo
