// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace trajlo {

/// The name of a layer between SQLite and its files, for the `vfs` parameter of a file's URI. It
/// lets SQLite open a file that was cut off, and makes every page that is not there an error: by
/// itself SQLite refuses such a file, or takes the missing pages for zeros and their zeros for
/// data. For files opened as immutable only.
const char* CutFileVfs();

/// Bytes that the header of a database (its first 100 bytes) promises; 0 if it does not say.
std::uint64_t DeclaredDatabaseSize(const char* header);

}  // namespace trajlo
