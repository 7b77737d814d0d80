// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "core/io/messages/cloud_message.h"

namespace trajlo {

/// sensor_msgs/PointCloud2; see DecodeCloud.
bool DecodePointCloud2(Encoding encoding, FileBytes* bytes, CloudMessage* cloud,
                       std::string* remark);

}  // namespace trajlo
