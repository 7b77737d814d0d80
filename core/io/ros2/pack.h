// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "core/io/ros2/unpack.h"

namespace trajlo {

/// Compresses, to be undone by Unpack(). The same bytes give the same. Throws std::runtime_error if
/// the library fails.
std::string Pack(Codec codec, std::string_view bytes);

}  // namespace trajlo
