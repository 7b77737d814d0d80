// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/io/messages/cloud_message.h"
#include "core/io/scan_listing.h"

namespace trajlo {

/// A folder of scans as if each file were a message: one topic, named as the folder. Files that
/// cannot be read are reported and passed over. There is no time of recording.
class FolderClouds : public CloudMessageReader {
 public:
  /// `stamps_ns` has one for each file, or is empty if only the points have times.
  FolderClouds(ScanListing listing, std::vector<std::int64_t> stamps_ns);

  const std::vector<Topic>& topics() const override { return topics_; }
  bool IsCloud(std::size_t topic) const override { return topic == 0; }
  void Select(const std::vector<std::size_t>&) override {}
  bool Next(CloudMessage* message) override;
  const MessageReport& report() const override { return report_; }

 private:
  ScanListing listing_;
  std::vector<std::int64_t> stamps_ns_;
  std::vector<Topic> topics_;
  MessageReport report_;
  std::size_t next_ = 0;
};

}  // namespace trajlo
