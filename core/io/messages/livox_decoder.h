// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "core/io/messages/cloud_message.h"

namespace trajlo {

/// CustomMsg of Livox's ROS drivers; see DecodeCloud.
bool DecodeLivox(Encoding encoding, FileBytes* bytes, CloudMessage* cloud, std::string* remark);

}  // namespace trajlo
