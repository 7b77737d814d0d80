// SPDX-License-Identifier: MIT
// What a recording holds, and how to run on it. See --help.
#include <gflags/gflags.h>

#include <cstdio>
#include <cstring>
#include <string>

#include "apps/info/info_job.h"
#include "apps/run/interrupt.h"
#include "core/report/versions.h"

DEFINE_bool(json, false, "print JSON");
DEFINE_bool(quick, false, "read the first messages only");
DEFINE_bool(quiet, false, "no progress");

namespace {

using trajlo::ExitCode;

constexpr char kHelp[] = R"(What a recording holds, and how to run on it.

  trajlo_info recording.bag
      topics, fields, rates, what the point times mean and by which evidence, gaps and other faults
      of the stamps, ranges, rings, how the LiDARs' sweeps lie to each other, and the trajlo_run
      line to use
  trajlo_info recording.bag --quick
      the first messages only
  trajlo_info a.bag b.mcap capture.pcap folder_of_scans
      ROS 1 bags, ROS 2 bags (.db3, .mcap, or the folder), packet captures, folders of scans
  trajlo_info recording.bag --json
      the same for programs

More flags: --quiet (no progress), --version

Exit codes: 0 ok, 1 wrong usage, 2 a recording is unreadable, 3 a recording is damaged (what can be
read is shown), 5 output not writable, 130 interrupted.
)";

bool Has(int argc, char** argv, std::initializer_list<const char*> flags) {
  for (int i = 1; i < argc; ++i) {
    for (const char* flag : flags) {
      if (std::strcmp(argv[i], flag) == 0) return true;
    }
  }
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  // Ahead of gflags, whose own help lists the flags of every library that is linked.
  if (Has(argc, argv, {"--help", "-help", "-h"})) {
    std::fputs(kHelp, stdout);
    return static_cast<int>(ExitCode::kOk);
  }
  if (Has(argc, argv, {"--version", "-version"})) {
    const trajlo::Versions versions = trajlo::GetVersions();
    std::printf("trajlo_info %s (commit %s)\n", versions.trajlo.c_str(), versions.git.c_str());
    return static_cast<int>(ExitCode::kOk);
  }
  gflags::ParseCommandLineNonHelpFlags(&argc, &argv, true);
  trajlo::InfoRequest request;
  request.recordings.assign(argv + 1, argv + argc);
  request.json = FLAGS_json;
  request.quick = FLAGS_quick;
  request.quiet = FLAGS_quiet;
  if (request.recordings.empty()) {
    std::fprintf(stderr, "trajlo_info: name a recording\n(trajlo_info --help shows examples)\n");
    return static_cast<int>(ExitCode::kUsage);
  }
  return static_cast<int>(trajlo::InfoJob(request, trajlo::HandleInterrupts()));
}
