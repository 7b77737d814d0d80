// SPDX-License-Identifier: MIT
#include "core/report/result_folder.h"

#include <gmock/gmock.h>

#include "core/io/errors.h"
#include "tests/support/temp_folder.h"

namespace trajlo {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using trajlo::testing::TempFolder;
using trajlo::testing::WriteFile;

std::string CheckError(const ResultFolder& folder, bool overwrite = false) {
  try {
    folder.Check(overwrite);
  } catch (const OutputError& error) {
    return error.what();
  }
  return "";
}

TEST(ResultFolder, NewEmptyAndForeignFoldersAreFine) {
  const TempFolder temp;
  EXPECT_EQ(CheckError(ResultFolder(temp / "new/deep")), "");
  EXPECT_FALSE(std::filesystem::exists(temp / "new"));
  EXPECT_EQ(CheckError(ResultFolder(temp.path())), "");
  WriteFile(temp / "notes.txt", "mine");
  EXPECT_EQ(CheckError(ResultFolder(temp.path())), "");
}

TEST(ResultFolder, AnyFileOfAnEarlierResultNeedsOverwrite) {
  for (const char* name :
       {"run.json", "trajectory.tum", "map.ply", "view.ply", "windows.csv", "config.yaml"}) {
    const TempFolder temp;
    WriteFile(temp / "run.json", "{}");
    WriteFile(temp / name, "old");
    EXPECT_THAT(CheckError(ResultFolder(temp.path())), HasSubstr("--overwrite")) << name;
    EXPECT_EQ(CheckError(ResultFolder(temp.path()), true), "");
  }
}

/// A simulated recording has a rig.yaml: the truth, which is not to be replaced.
TEST(ResultFolder, FilesOfOthersAreNeverReplaced) {
  for (const char* name : {"rig.yaml", "config.yaml", "map.ply"}) {
    const TempFolder temp;
    WriteFile(temp / name, "mine");
    for (const bool overwrite : {false, true}) {
      EXPECT_THAT(CheckError(ResultFolder(temp.path()), overwrite),
                  AllOf(HasSubstr(name), HasSubstr("no run.json"), Not(HasSubstr("--overwrite"))));
    }
  }
}

TEST(ResultFolder, AFileInTheWayIsAnErrorEvenWithOverwrite) {
  const TempFolder temp;
  WriteFile(temp / "file", "x");
  EXPECT_THAT(CheckError(ResultFolder(temp / "file"), true), HasSubstr("not a folder"));
  EXPECT_THROW(ResultFolder(temp / "file/below").Prepare(), OutputError);
}

TEST(ResultFolder, PrepareRemovesTheEarlierResultAndNothingElse) {
  const TempFolder temp;
  WriteFile(temp / "map.ply", "old");
  WriteFile(temp / "notes.txt", "mine");
  std::filesystem::create_symlink("/dev/null", temp / "windows.csv");
  ResultFolder(temp.path()).Prepare();
  EXPECT_FALSE(std::filesystem::exists(temp / "map.ply"));
  EXPECT_TRUE(std::filesystem::exists(temp / "notes.txt"));
  EXPECT_TRUE(std::filesystem::is_symlink(temp / "windows.csv"));
}

}  // namespace
}  // namespace trajlo
