// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/io/messages/cloud_message.h"
#include "core/io/messages/raw_message.h"
#include "core/io/messages/report_merger.h"

namespace trajlo {

/// The point clouds among the messages of a ROS bag: topics of the types that IsCloudType names.
/// A message that cannot be decoded is counted as lost, and the report has one sentence a topic
/// about such messages; whatever else is odd about a topic's messages is reported once.
class RosCloudReader final : public CloudMessageReader {
 public:
  /// `path` is for the report's sentences.
  RosCloudReader(std::unique_ptr<RawMessageReader> reader, std::filesystem::path path);

  const std::vector<Topic>& topics() const override { return reader_->topics(); }
  bool IsCloud(std::size_t topic) const override;
  void Select(const std::vector<std::size_t>& topics) override;
  bool Next(CloudMessage* message) override;
  const MessageReport& report() const override { return report_; }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  /// What was seen of one topic. Warnings are kept by their index in the report.
  struct TopicState {
    std::size_t undecodable = 0;
    std::size_t undecodable_warning = kNone;
    std::string first_reason;
    bool oddity_reported = false;
  };

  void ReportUndecodable(const std::string& reason);
  void ReportOddity(const std::string& remark);

  std::unique_ptr<RawMessageReader> reader_;
  std::filesystem::path path_;
  std::vector<TopicState> states_;
  bool any_selected_ = false;
  RawMessage raw_;
  MessageReport report_;
  ReportMerger merger_;
};

}  // namespace trajlo
