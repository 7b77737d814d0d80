// SPDX-License-Identifier: MIT
#include "apps/simulate/write_recording.h"

#include <chrono>
#include <cstdio>
#include <stdexcept>
#include <system_error>

#include "core/io/conversion/pcd_folder_writer.h"
#include "core/io/format_text.h"
#include "core/simulation/scan_stream.h"

namespace trajlo {
namespace {

namespace fs = std::filesystem;

/// Makes sure that nothing is lost, and that nothing of an older recording stays behind.
void PrepareOutput(const RecordingRequest& request) {
  const fs::path& output = request.output;
  std::error_code error;
  if (!fs::exists(output, error) || fs::is_empty(output, error)) return;
  if (!request.overwrite) {
    throw std::runtime_error("'" + output.string() +
                             "' is not empty; choose another folder or add --overwrite");
  }
  RemoveScans(output);
  fs::remove_all(output / "velodyne", error);
  for (const char* old : {"recording.bag", "times.txt", "poses.txt"}) {
    fs::remove(output / old, error);
  }
}

void Print(const simulation::RecordingWriter& writer, const simulation::Scenario& scenario,
           const fs::path& output, bool is_whole, double seconds) {
  const double million_points = 1e-6 * static_cast<double>(writer.points());
  const std::string scans = CountOf(writer.scans(), "scan");
  std::printf(
      "%s: %.1f s, %s, %.2f million points in %s\n%.1f s to simulate, %.2f million "
      "points a second\n",
      scenario.name.c_str(), is_whole ? scenario.duration_s : writer.seconds(), scans.c_str(),
      million_points, output.c_str(), seconds, million_points / seconds);
  if (is_whole) return;
  std::fprintf(stderr,
               "trajlo_simulate: a signal ended it early; what was simulated until then, %s, "
               "is a complete, shorter recording\n",
               scans.c_str());
}

}  // namespace

bool WriteRecording(const simulation::Simulator& simulator, const RecordingRequest& request,
                    const std::atomic<bool>& stop) {
  PrepareOutput(request);
  const auto begin = std::chrono::steady_clock::now();
  simulation::RecordingWriter writer(simulator, request.output, request.bag);
  simulation::ScanStream stream(simulator, request.threads);
  simulation::SimulatedScan scan;
  bool is_whole = false;
  while (!stop) {
    is_whole = !stream.Next(&scan);
    if (is_whole) break;
    writer.Write(scan);
  }
  writer.Finish(is_whole);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  Print(writer, simulator.scenario(), request.output, is_whole, spent.count());
  return is_whole;
}

}  // namespace trajlo
