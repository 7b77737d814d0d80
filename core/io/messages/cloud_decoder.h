// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "core/io/messages/cloud_message.h"
#include "core/io/messages/raw_message.h"

namespace trajlo {

/// True for sensor_msgs/PointCloud2 and for CustomMsg of livox_ros_driver and livox_ros_driver2.
bool IsCloudType(std::string_view type);

/// Moves the bytes of `raw` into `cloud->table`, whose columns point into them; points are not
/// copied, except for rows with padding behind them, which are moved together.
///
/// PointCloud2: every field of the types that ROS 1 and ROS 2 define is a column (of a field with a
/// count above one, the first element). The sizes that it declares are not believed: the table
/// holds the points that are there, and `table.damage` says how many are missing.
///
/// Livox CustomMsg: columns offset_time (uint32, ns), x, y, z (float32, m), reflectivity, tag and
/// line (uint8). Points whose tag marks them as noise stay. `stamp_ns` is what `offset_time` counts
/// from: the `timebase`, of which Livox's drivers also make the header's stamp (in ROS 1 by way of
/// a double, which costs it 200 ns). Changed drivers stamp the header when they publish; so the
/// timebase is believed up to a second of difference. More than that is another clock (the LiDAR's
/// may count from its start), and the header's stamp is taken, to agree with other topics. The
/// remark tells of a difference above a millisecond.
///
/// False: this is no such message, `raw` is as it was, and `remark` says why.
/// True: `remark` is empty or a sentence about what is odd.
bool DecodeCloud(const Topic& topic, RawMessage* raw, CloudMessage* cloud, std::string* remark);

}  // namespace trajlo
