// SPDX-License-Identifier: MIT
#include "core/io/inspection/folder_clouds.h"

#include <utility>

#include "core/io/errors.h"
#include "core/io/point_file.h"

namespace trajlo {

FolderClouds::FolderClouds(ScanListing listing, std::vector<std::int64_t> stamps_ns)
    : listing_(std::move(listing)), stamps_ns_(std::move(stamps_ns)) {
  Topic topic;
  topic.name = listing_.folder.string();
  topic.type = listing_.extension + " files";
  topic.messages = listing_.files.size();
  topics_.push_back(std::move(topic));
  report_.warnings = listing_.warnings;
  report_.damaged = listing_.left_out > 0;
}

bool FolderClouds::Next(CloudMessage* message) {
  while (next_ < listing_.files.size()) {
    const std::size_t i = next_++;
    const std::filesystem::path& file = listing_.files[i];
    try {
      message->table = ReadPointFile(file);
    } catch (const InputError& error) {
      report_.damaged = true;
      report_.warnings.emplace_back(error.what());
      continue;
    }
    message->topic = 0;
    message->stamp_ns.reset();
    if (!stamps_ns_.empty()) message->stamp_ns = stamps_ns_[i];
    return true;
  }
  return false;
}

}  // namespace trajlo
