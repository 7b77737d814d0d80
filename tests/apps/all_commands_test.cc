// SPDX-License-Identifier: MIT
// What all commands have in common: how they are called.
#include <gmock/gmock.h>

#include <fstream>
#include <set>
#include <sstream>

#include "tests/apps/command_testing.h"
#include "tests/support/room_recording.h"
#include "tests/support/temp_folder.h"

namespace trajlo::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

const fs::path kPrograms = TRAJLO_PROGRAMS;

Outcome Call(const std::string& command, const std::vector<std::string>& arguments) {
  return CallProgram((kPrograms / command).c_str(), arguments);
}

class AnyCommand : public ::testing::TestWithParam<const char*> {
 protected:
  static std::set<std::string> FlagsOf(const std::string& command) {
    std::istringstream words(Call(command, {"--complete", "", "--"}).out);
    std::set<std::string> flags;
    for (std::string word; words >> word;) flags.insert(word.substr(0, word.find('=')));
    return flags;
  }
};
INSTANTIATE_TEST_SUITE_P(Is, AnyCommand,
                         ::testing::Values("trajlo_run", "trajlo_info", "trajlo_convert",
                                           "trajlo_evaluate", "trajlo_simulate",
                                           "trajlo_compare_solvers"),
                         [](const auto& test) { return std::string(test.param); });

TEST_P(AnyCommand, HelpIsShortLinesAndNamesExitCodes) {
  const Outcome help = Call(GetParam(), {"-h"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_EQ(help.out, Call(GetParam(), {"--help"}).out);
  EXPECT_THAT(help.out, HasSubstr("Exit codes: 0 "));
  std::istringstream lines(help.out);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 110u) << line;
}

TEST_P(AnyCommand, HelpNamesNoFlagThatThereIsNot) {
  std::set<std::string> flags = FlagsOf(GetParam());
  ASSERT_GT(flags.size(), 4u);
  flags.merge(FlagsOf("trajlo_run"));  // To which the others refer.
  flags.insert("--completion");
  std::istringstream words(Call(GetParam(), {"--help"}).out);
  for (std::string word; words >> word;) {
    if (word.compare(0, 2, "--") != 0 || word.size() == 2) continue;
    const std::string flag = word.substr(0, word.find_first_of("=,.;:)|"));
    const std::string opposite =
        flag.compare(0, 4, "--no") == 0 ? "--" + flag.substr(4) : "--no" + flag.substr(2);
    EXPECT_TRUE(flags.count(flag) + flags.count(opposite) > 0) << flag;
  }
}

TEST_P(AnyCommand, EveryFlagIsInTheHelp) {
  const std::string help = Call(GetParam(), {"--help"}).out;
  for (const std::string& flag : FlagsOf(GetParam())) EXPECT_THAT(help, HasSubstr(flag));
}

TEST_P(AnyCommand, AMisspeltFlagIsOneWithTheNearest) {
  const Outcome outcome = Call(GetParam(), {"--verison"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("unknown flag --verison; did you mean --version?"));
}

TEST_P(AnyCommand, WithoutAnythingItSaysWhatItNeeds) {
  const Outcome outcome = Call(GetParam(), {});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr(GetParam()), HasSubstr("--help")));
}

/// What bash offers for a line whose end is the cursor, as it would show it.
std::string Offered(const std::string& line) {
  const TempFolder folder;
  std::ofstream script(folder / "complete.sh");
  // Bash splits the words at `=`, too.
  script << "compopt() { :; }\nPATH=" << kPrograms.string() << ":$PATH\n"
         << "source <(trajlo_run --completion=bash)\n"
         << "COMP_WORDBREAKS=$' \\t\\n\"\\'><=;|&(:'\nCOMP_LINE='" << line
         << "'\nCOMP_POINT=${#COMP_LINE}\n"
         << "read -r -a COMP_WORDS <<< \"${COMP_LINE//=/ = }\"\n"
         << "[[ $COMP_LINE == *[[:space:]=] ]] && COMP_WORDS+=('')\n"
         << "COMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n"
         << "complete -p ${COMP_WORDS[0]} > /dev/null || exit 9\n"
         << "_trajlo\necho \"${COMPREPLY[*]}\"\n";
  script.close();
  const Outcome outcome = CallProgram("/usr/bin/bash", {(folder / "complete.sh").string()});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  return outcome.out.substr(0, outcome.out.size() - 1);
}

TEST(Completion, BashOffersFlagsConfigurationsScenariosAndOptions) {
  EXPECT_EQ(Offered("trajlo_run flight.bag --cov"), "--covariance");
  EXPECT_EQ(Offered("trajlo_run flight.bag --thr"), "--threads=");
  EXPECT_EQ(Offered("trajlo_run flight.bag --config=oust"), "ouster");
  EXPECT_EQ(Offered("trajlo_run flight.bag --config=indoor,oust"), "indoor,ouster");
  EXPECT_EQ(Offered("trajlo_run flight.bag -c oust"), "ouster");
  EXPECT_EQ(Offered("trajlo_run flight.bag --solver="), "ceres gauss_newton");
  EXPECT_EQ(Offered("trajlo_run flight.bag --set window.segm"), "window.segments=");
  EXPECT_EQ(Offered("trajlo_run flight.bag --set=window.segments=4,map.rad"), "4,map.radius_m=");
  EXPECT_EQ(Offered("trajlo_run flight.bag --set window.segments=4,map.rad"), "4,map.radius_m=");
  EXPECT_EQ(Offered("trajlo_simulate hall_os1_16x"), "hall_os1_16x2");
  EXPECT_EQ(Offered("trajlo_simulate --scenario=hall_os1_16x"), "hall_os1_16x2");
  EXPECT_EQ(Offered("trajlo_evaluate a b --alignment=sim"), "sim3");
  EXPECT_EQ(Offered("trajlo_run fli"), "") << "files are bash's own";
}

TEST(Completion, BashOffersTheValuesOfOptions) {
  EXPECT_EQ(Offered("trajlo_run flight.bag --set solver.k"), "solver.kind=");
  EXPECT_EQ(Offered("trajlo_run flight.bag --set solver.kind="), "ceres gauss_newton");
  EXPECT_EQ(Offered("trajlo_run flight.bag --set=solver.kind=ga"), "gauss_newton");
  EXPECT_EQ(Offered("trajlo_run flight.bag --set=map.radius_m=9,solver.kind=ce"), "ceres");
  EXPECT_EQ(Offered("trajlo_run flight.bag --set motion_prior.self_tuning="), "true false");
  EXPECT_EQ(Offered("trajlo_run flight.bag --set map.radius_m="), "") << "a number";
  EXPECT_EQ(Offered("trajlo_simulate hall_os1_16 --set moving_objects="), "true false");
  EXPECT_EQ(Offered("trajlo_simulate hall_os1_16 --set=motion.kind=fli"), "flight");
}

TEST(Completion, OffersZshWholeWords) {
  const auto offered = [](const std::string& previous, const std::string& word) {
    return Call("trajlo_run", {"--complete", previous, word}).out;
  };
  EXPECT_EQ(offered("--set", "solver.kind="), "solver.kind=ceres\nsolver.kind=gauss_newton\n");
  EXPECT_EQ(offered("flight.bag", "--set=map.radius_m=9,solver.kind=ga"),
            "--set=map.radius_m=9,solver.kind=gauss_newton\n");
}

TEST(Completion, OtherShellsAreRefused) {
  EXPECT_THAT(Call("trajlo_run", {"--completion", "zsh"}).out, HasSubstr("#compdef trajlo_run"));
  EXPECT_EQ(Call("trajlo_run", {"--completion=fish"}).exit_code, 1);
}

TEST(Commands, SayWhatIsMeantByAMisspeltScenario) {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"hall_os1_61", "-o", "/nowhere"},
        {"hall_os1_1", "-o", "/nowhere"},
        {"--list", "hall_os1_61"},
        {"--list_parameters", "--scenario=hall_os1_61"}}) {
    const Outcome outcome = Call("trajlo_simulate", words);
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err, HasSubstr("; did you mean 'hall_os1_16'?"));
  }
}

TEST(Commands, TakeTheirInputAsAnArgument) {
  const TempFolder folder;
  const auto path = [&](const char* name) { return (folder / name).string(); };
  ASSERT_EQ(
      Call("trajlo_simulate", {"hall_os1_16", "-o", path("hall"), "--duration_s", "1"}).exit_code,
      0);
  const Outcome run =
      Call("trajlo_run", {path("hall"), "-o", path("result"), "-c", path("hall/rig.yaml"), "--set",
                          "window.segments=3", "--set", "registration.sigma_m=0.05,threads=1"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(ReadFile(folder / "result/config.yaml"),
              AllOf(HasSubstr("\n  segments: 3\n"), HasSubstr("\n  sigma_m: 0.05\n"),
                    HasSubstr("\nthreads: 1\n")));
  EXPECT_EQ(Call("trajlo_info", {"--input", path("hall")}).exit_code, 0);
  EXPECT_EQ(Call("trajlo_convert", {path("hall"), "-o", path("hall.bag")}).exit_code, 0);
  const Outcome evaluate =
      Call("trajlo_evaluate", {path("result/trajectory.tum"), path("hall/truth.tum"), "-o",
                               path("errors"), "--alignment", "none", "--noreport"});
  EXPECT_EQ(evaluate.exit_code, 0) << evaluate.err;
  EXPECT_TRUE(fs::exists(folder / "errors/evaluation.json"));
}

TEST(Commands, ASecondArgumentThatIsNoRecordingIsExplained) {
  const TempFolder folder;
  RoomRecording().Write(folder / "in");
  const Outcome outcome = Call("trajlo_run", {(folder / "in").string(), "result"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("to write there: -o result"));
}

TEST(Commands, AKeyThatIsSetTwiceIsRefused) {
  const Outcome outcome = Call(
      "trajlo_run", {"--show_config", "--set", "window.segments=3", "--set", "window.segments=4"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("'window.segments' is set twice"));
  EXPECT_EQ(Call("trajlo_simulate",
                 {"hall_os1_16", "--list_parameters", "--set", "seed=2", "--set", "seed=3"})
                .exit_code,
            1);
}

TEST(Commands, AFlagAndTheOptionThatItIsShortForMustNotContradict) {
  const auto error = [](const std::string& program, const std::vector<std::string>& arguments) {
    const Outcome outcome = Call(program, arguments);
    EXPECT_EQ(outcome.exit_code, 1) << arguments.front();
    return outcome.err;
  };
  const std::vector<std::string> one = {"--show_config", "--set=solver.kind=ceres"};
  EXPECT_THAT(error("trajlo_run", {"--solver=gauss_newton", one[0], one[1]}),
              HasSubstr("--solver=gauss_newton sets solver.kind, and --set gives it another "
                        "value"));
  EXPECT_EQ(Call("trajlo_run", {"--solver=ceres", one[0], one[1]}).exit_code, 0);
  EXPECT_THAT(error("trajlo_run", {"--show_config", "--threads=2", "--set=threads=3"}),
              HasSubstr("--threads=2"));
  // Nor does a flag set an option of another name.
  EXPECT_THAT(error("trajlo_run", {"--show_config", "--solver=ceres,threads=3"}),
              HasSubstr("'solver.kind' must be one of ceres | gauss_newton"));
  EXPECT_THAT(
      error("trajlo_simulate", {"hall_os1_16", "--list_parameters", "--seed=2", "--set=seed=3"}),
      HasSubstr("--seed"));
}

TEST(Commands, AnEmptyValueIsNotIgnored) {
  for (const char* flag : {"--config", "--set", "-c", "--input", "--output"}) {
    const Outcome outcome = Call("trajlo_run", {"--show_config", flag, ""});
    EXPECT_EQ(outcome.exit_code, 1) << flag;
    EXPECT_THAT(outcome.err, HasSubstr("needs a value")) << flag;
  }
  EXPECT_THAT(Call("trajlo_evaluate", {"a.tum", "--truth", ""}).err,
              HasSubstr("--truth needs a value"));
}

TEST(ConfigurationNames, AreFoundInTheBuildAndInAnInstallation) {
  const TempFolder folder;
  const fs::path before = fs::current_path();
  fs::current_path(folder.path());  // Programs are called from there.
  const Outcome built = Call("trajlo_run", {"--list_configs"});
  fs::create_directories(folder / "usr/bin");
  fs::create_directories(folder / "usr/share/trajlo/config/datasets");
  fs::copy_file(kPrograms / "trajlo_run", folder / "usr/bin/trajlo_run");
  WriteFile(folder / "usr/share/trajlo/config/datasets/mine.yaml",
            "# My LiDAR.\nwindow: {segments: 9}\n");
  fs::create_symlink(folder / "usr/bin/trajlo_run", folder / "link");
  const Outcome installed = CallProgram((folder / "link").c_str(), {"--list_configs"});
  const Outcome shown =
      CallProgram((folder / "link").c_str(), {"--show_config", "--config", "mine"});
  fs::current_path(before);
  EXPECT_THAT(built.out, AllOf(HasSubstr("\nouster "), HasSubstr("\nindoor ")));
  EXPECT_EQ(installed.out, "mine                   My LiDAR.\n");
  EXPECT_THAT(shown.out, HasSubstr("\n  segments: 9\n"));
}

}  // namespace
}  // namespace trajlo::testing
