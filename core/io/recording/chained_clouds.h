// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "core/io/messages/cloud_message.h"
#include "core/io/messages/report_merger.h"

namespace trajlo {

/// Files that follow each other in time, as recorders split them, read as one. Topics of the same
/// name are one topic.
class ChainedClouds : public CloudMessageReader {
 public:
  /// `parts` in the order of time; at least one.
  explicit ChainedClouds(std::vector<std::unique_ptr<CloudMessageReader>> parts);

  const std::vector<Topic>& topics() const override { return topics_; }
  bool IsCloud(std::size_t topic) const override { return is_cloud_[topic]; }
  void Select(const std::vector<std::size_t>& topics) override;
  bool Next(CloudMessage* message) override;
  const MessageReport& report() const override { return report_; }

 private:
  struct Part {
    std::unique_ptr<CloudMessageReader> reader;
    /// Of the part's topics, their place in the common list.
    std::vector<std::size_t> common_topic;
    ReportMerger merger;
  };

  std::vector<Part> parts_;
  std::vector<Topic> topics_;
  std::vector<bool> is_cloud_;
  MessageReport report_;
  std::size_t current_ = 0;
};

}  // namespace trajlo
