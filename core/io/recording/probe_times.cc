// SPDX-License-Identifier: MIT
#include "core/io/recording/probe_times.h"

#include <algorithm>

namespace trajlo {

std::vector<std::string> ProbeTimes(const std::vector<std::size_t>& topics,
                                    CloudMessageReader* reader, std::vector<TimeProbe>* probes) {
  std::vector<std::string> frame_ids(topics.size());
  reader->Select(topics);
  std::size_t missing = probes->size();
  CloudMessage message;
  for (std::size_t n = 0; n < TimeProbe::kMostScans && missing > 0 && reader->Next(&message); ++n) {
    const auto i = static_cast<std::size_t>(std::find(topics.begin(), topics.end(), message.topic) -
                                            topics.begin());
    TimeProbe& probe = (*probes)[i];
    if (probe.readable() == 0) frame_ids[i] = message.frame_id;
    if (probe.IsComplete()) continue;
    probe.Note(probe.path(), message.table, message.stamp_ns, message.recorded_ns);
    missing -= probe.IsComplete() ? 1 : 0;
  }
  return frame_ids;
}

}  // namespace trajlo
