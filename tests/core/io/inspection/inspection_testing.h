// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/io/inspection/inspection.h"

namespace trajlo::testing {

/// A cloud with points of which nothing is wrong.
inline CloudInspection Cloud(const std::string& topic, std::vector<FieldDescription> fields) {
  CloudInspection cloud;
  cloud.topic = topic;
  cloud.type = "sensor_msgs/PointCloud2";
  cloud.fields = std::move(fields);
  cloud.messages_read = 10;
  cloud.points.total = 100'000;
  cloud.convention.field = "t";
  cloud.convention.stamp_at = StampAt::kEnd;
  return cloud;
}

}  // namespace trajlo::testing
