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

TEST(ResultFolder, PagesAndEvaluationsOfAnEarlierResultGoWithIt) {
  const TempFolder temp;
  for (const bool is_result : {false, true}) {
    if (is_result) WriteFile(temp / "run.json", "{}");
    std::filesystem::create_directories(temp / "figures");
    for (const char* name : {"run.html", "figures/map.svg", "evaluation.csv", "report.html",
                             "errors_a.csv", "errors_mine.csv"}) {
      WriteFile(temp / name, "old");
    }
    WriteFile(temp / "evaluation.json", R"({"estimates": [{"errors_csv": "errors_a.csv"}]})");
    ResultFolder(temp.path()).Prepare();
    for (const char* name : {"run.html", "figures", "evaluation.csv", "evaluation.json",
                             "report.html", "errors_a.csv"}) {
      EXPECT_EQ(std::filesystem::exists(temp / name), !is_result) << name;
    }
    EXPECT_TRUE(std::filesystem::exists(temp / "errors_mine.csv"));
  }
}

TEST(ResultFolder, FiguresAndTablesOfOthersStay) {
  const TempFolder temp;
  std::filesystem::create_directories(temp / "figures");
  for (const char* name : {"run.json", "figures/mine.png", "figures/map.png", "evaluation.csv"}) {
    WriteFile(temp / name, "old");
  }
  ResultFolder(temp.path()).Prepare();
  EXPECT_TRUE(std::filesystem::exists(temp / "figures/mine.png"));
  EXPECT_FALSE(std::filesystem::exists(temp / "figures/map.png"));
  EXPECT_TRUE(std::filesystem::exists(temp / "evaluation.csv"));  // No evaluation.json.
}

}  // namespace
}  // namespace trajlo
