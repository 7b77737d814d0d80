// SPDX-License-Identifier: MIT
#include "apps/read_flags.h"

#include <gmock/gmock.h>

#include "apps/completion.h"
#include "apps/usage_error.h"

DEFINE_string(output, "", "");
DEFINE_string(set, "", "");
DEFINE_double(start_s, 0.0, "");
DEFINE_int32(threads, -1, "");
DEFINE_bool(quiet, false, "");
DEFINE_bool(view, true, "");

namespace trajlo {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;
using ::testing::Not;

using Words = std::vector<std::string>;

/// The flags of this file go back to their defaults after each test.
class ReadFlagsTest : public ::testing::Test {
 protected:
  static Words Read(Words words) {
    words.insert(words.begin(), "program");
    return ReadFlags("read_flags_test", words);
  }

  static std::string Error(const Words& words) {
    try {
      Read(words);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  }

  gflags::FlagSaver saver_;
};

TEST_F(ReadFlagsTest, TakesTheValueBehindEqualsOrAsTheNextWord) {
  for (const Words& words : {Words{"--output=a b"}, Words{"--output", "a b"}, Words{"-o", "a b"},
                             Words{"-o=a b"}, Words{"-output", "a b"}}) {
    const gflags::FlagSaver saver;
    EXPECT_THAT(Read(words), IsEmpty());
    EXPECT_EQ(FLAGS_output, "a b") << words.front();
  }
}

TEST_F(ReadFlagsTest, TellsArgumentsFromFlagsWhereverTheyStand) {
  EXPECT_THAT(Read({"first", "--quiet", "second", "-o", "out", "-", "--", "--set"}),
              ElementsAre("first", "second", "-", "--set"));
  EXPECT_TRUE(FLAGS_quiet);
  EXPECT_EQ(FLAGS_output, "out");
}

TEST_F(ReadFlagsTest, ANegativeNumberIsAValueAndAFlagIsNone) {
  Read({"--start-s", "-0.5"});
  EXPECT_EQ(FLAGS_start_s, -0.5);
  EXPECT_THAT(Error({"--output", "--quiet"}), HasSubstr("--output needs a value"));
  EXPECT_THAT(Error({"-o"}), HasSubstr("--output needs a value"));
}

TEST_F(ReadFlagsTest, SwitchesTakeTheNextWordOnlyIfItIsTrueOrFalse) {
  EXPECT_THAT(Read({"--noview", "--quiet", "true", "file"}), ElementsAre("file"));
  EXPECT_FALSE(FLAGS_view);
  EXPECT_TRUE(FLAGS_quiet);
}

TEST_F(ReadFlagsTest, ListsMayBeGivenInParts) {
  Read({"--set", "a=1", "--set=b=[2,3],c=4"});
  EXPECT_EQ(FLAGS_set, "a=1,b=[2,3],c=4");
}

TEST_F(ReadFlagsTest, AnythingElseThatIsGivenTwiceIsRefusedUnlessItIsTheSame) {
  EXPECT_THAT(Error({"--threads=1", "--threads=2"}), HasSubstr("--threads is given twice"));
  EXPECT_EQ(Error({"--threads=1", "--threads=1"}), "");
}

TEST_F(ReadFlagsTest, UnknownFlagsComeWithTheNearest) {
  EXPECT_EQ(Error({"--thread=2"}), "unknown flag --thread; did you mean --threads?");
  EXPECT_EQ(Error({"--Output", "x"}), "unknown flag --Output; did you mean --output?");
  EXPECT_EQ(Error({"--vresion"}), "unknown flag --vresion; did you mean --version?");
  EXPECT_EQ(Error({"--xyzzyplugh"}), "unknown flag --xyzzyplugh");
  EXPECT_EQ(Error({"--no-view"}), "unknown flag --no-view; did you mean --noview?");
  EXPECT_EQ(Error({"--noview=true"}),
            "unknown flag --noview with a value; --view=false, or --noview alone");
  EXPECT_EQ(Error({"-q"}), "unknown flag -q; did you mean --quiet?");
  EXPECT_EQ(Error({"-v"}), "unknown flag -v; did you mean --version?");
  EXPECT_EQ(Error({"-V"}), "unknown flag -V; did you mean --version?");
  EXPECT_EQ(Error({"-z"}), "unknown flag -z");
  EXPECT_EQ(Error({"--minloglevel=2"}), "unknown flag --minloglevel");
  EXPECT_EQ(Error({"--window.segments=3"}),
            "unknown flag --window.segments; options are set with --set window.segments=3");
}

TEST_F(ReadFlagsTest, AnEmptyValueIsNoneAndIsNotIgnored) {
  for (const Words& words : {Words{"--output", ""}, Words{"-o="}, Words{"--output= "}}) {
    EXPECT_EQ(Error(words), "--output needs a value: --output=...");
  }
  EXPECT_EQ(Error({"--set", "a=1", "--set="}), "--set needs a value: --set=...");
  EXPECT_EQ(Error({"--set=,"}), "--set needs a value: --set=...");
  EXPECT_EQ(Error({"--start_s="}), "--start_s needs a value: --start_s=...");
  EXPECT_EQ(Error({""}), "an argument is empty");
}

TEST_F(ReadFlagsTest, WrongValuesAreNamedWithWhatIsAllowed) {
  EXPECT_EQ(Error({"--threads", "two"}), "--threads: must be a whole number, found 'two'");
  EXPECT_EQ(Error({"--quiet=perhaps"}), "--quiet: must be true or false, found 'perhaps'");
}

class CompleteTest : public ::testing::Test {
 protected:
  static Words At(const std::string& previous, const std::string& word) {
    Command command;
    command.name = "read_flags_test";
    command.values = [](const std::string& flag) {
      if (flag == "output") return Words{"out1", "out2"};
      return flag.empty() ? Words{"hall", "street"} : Words{};
    };
    return Complete(command, previous, word);
  }
};

TEST_F(CompleteTest, FlagsEndWithEqualsUnlessTheyAreSwitches) {
  EXPECT_THAT(At("program", "--"),
              IsSupersetOf({"--help", "--version", "--output=", "--set=", "--quiet", "--noview"}));
  EXPECT_THAT(At("program", "--"), Not(Contains("--minloglevel=")));
  EXPECT_THAT(At("program", "--th"), ElementsAre("--threads="));
}

TEST_F(CompleteTest, ValuesAreThoseOfTheFlagBeforeOrOfTheArgument) {
  EXPECT_THAT(At("x", "--output=o"), ElementsAre("--output=out1", "--output=out2"));
  EXPECT_THAT(At("--output", "o"), ElementsAre("out1", "out2"));
  EXPECT_THAT(At("-o", "out2"), ElementsAre("out2"));
  EXPECT_THAT(At("--quiet", "ha"), ElementsAre("hall"));
  EXPECT_THAT(At("program", ""), ElementsAre("hall", "street"));
  EXPECT_THAT(At("--output", "file"), IsEmpty());
}

TEST_F(CompleteTest, OfAListThePartBehindTheCommaIsCompleted) {
  EXPECT_THAT(At("x", "--set=a=1,window.segm"), ElementsAre("--set=a=1,window.segments="));
}

}  // namespace
}  // namespace trajlo
