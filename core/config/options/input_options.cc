// SPDX-License-Identifier: MIT
// How the recording is read.
#include "core/config/options/bind_options.h"
#include "core/config/options/option_binder.h"

namespace trajlo {
namespace {

const Names<bool> kPointTimes = {{"auto", true}, {"none", false}};
const Names<TimeUnit> kTimeUnits = {{"auto", TimeUnit::kAuto},
                                    {"s", TimeUnit::kSeconds},
                                    {"ms", TimeUnit::kMilliseconds},
                                    {"us", TimeUnit::kMicroseconds},
                                    {"ns", TimeUnit::kNanoseconds}};
const Names<TimeOrigin> kTimeOrigins = {{"auto", TimeOrigin::kAuto},
                                        {"start", TimeOrigin::kSweepStart},
                                        {"stamp", TimeOrigin::kStamp},
                                        {"end", TimeOrigin::kSweepEnd},
                                        {"absolute", TimeOrigin::kAbsolute}};
const Names<StampAt> kStampEnds = {
    {"auto", StampAt::kAuto}, {"start", StampAt::kStart}, {"end", StampAt::kEnd}};

Names<std::optional<VelodyneModel>> VelodyneModels() {
  Names<std::optional<VelodyneModel>> names = {{"auto", std::nullopt}};
  for (const auto& [name, model] : kVelodyneModels) names.emplace_back(name, model);
  return names;
}

}  // namespace

void BindInput(RecordingOptions* input, OptionBinder* b) {
  b->Add("input.topics", input->topics,
         "Topics of a bag to read, one per LiDAR; empty takes the only one with point clouds.");
  b->Add("input.point_time", input->use_point_times, kPointTimes,
         "none: ignore per-point times, as motion-corrected scans need it; every point then gets "
         "its scan's stamp.");
  b->Add("input.time_field", input->time_field,
         "Name of the field with the points' times; empty takes the first with a known name.");
  b->Add("input.time_unit", input->time_unit, kTimeUnits,
         "Unit of the points' times; auto decides by the evidence of the first scans.");
  b->Add("input.time_origin", input->time_origin, kTimeOrigins,
         "What a point time of zero means: start or end of the sweep, the scan's stamp, or the "
         "zero of an absolute clock.");
  b->Add("input.stamp_at", input->stamp_at, kStampEnds,
         "Which end of the sweep a scan's stamp marks.");
  b->Add("input.clock_offset_s", input->clock_offset_s, Range<double>{-1e9, 1e9},
         "Added to the stamps and times of a LiDAR whose clock is late by this much.");
  b->Add("input.stamps_file", input->stamps_file,
         "File with one stamp a line; empty searches for timestamps.txt or times.txt.");
  b->Add("input.scan_period_s", input->scan_period_s, Range<double>{1e-3, 100.0},
         "Time between scans when nothing else gives stamps.");
  b->Add("input.velodyne_model", input->velodyne_model, VelodyneModels(),
         "Of Velodynes in a capture whose packets do not name it (old firmware); auto refuses "
         "these. VLP-16 is also the Puck LITE.");
  b->Add("input.start_s", input->start_s, Range<double>{0.0, 1e9},
         "Scans before this much time since the first are skipped.");
  b->Add("input.duration_s", input->duration_s, Range<double>{0.0, 1e9},
         "The length of what is read; 0 reads to the end.");
}

}  // namespace trajlo
