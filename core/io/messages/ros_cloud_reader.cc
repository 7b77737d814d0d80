// SPDX-License-Identifier: MIT
#include "core/io/messages/ros_cloud_reader.h"

#include <utility>

#include "core/io/format_text.h"
#include "core/io/messages/cloud_decoder.h"

namespace trajlo {

RosCloudReader::RosCloudReader(std::unique_ptr<RawMessageReader> reader, std::filesystem::path path)
    : reader_(std::move(reader)), path_(std::move(path)), states_(reader_->topics().size()) {
  std::vector<std::size_t> clouds;
  for (std::size_t i = 0; i < states_.size(); ++i) {
    if (IsCloud(i)) clouds.push_back(i);
  }
  Select(clouds);
  merger_.Take(reader_->report(), &report_);
}

bool RosCloudReader::IsCloud(std::size_t topic) const {
  return topic < topics().size() && IsCloudType(topics()[topic].type);
}

void RosCloudReader::Select(const std::vector<std::size_t>& topics) {
  std::vector<std::size_t> clouds;
  for (const std::size_t topic : topics) {
    if (IsCloud(topic)) clouds.push_back(topic);
  }
  any_selected_ = !clouds.empty();
  reader_->Select(clouds);
}

bool RosCloudReader::Next(CloudMessage* message) {
  while (any_selected_) {
    // A moved-from FileBytes keeps its size: a reader would take it for memory to reuse.
    raw_.bytes = std::exchange(message->table.bytes, {});
    const bool got = reader_->Next(&raw_);
    merger_.Take(reader_->report(), &report_);
    if (!got) return false;
    std::string remark;
    if (DecodeCloud(topics()[raw_.topic], &raw_, message, &remark)) {
      if (!remark.empty()) ReportOddity(remark);
      return true;
    }
    ReportUndecodable(remark);
  }
  return false;
}

void RosCloudReader::ReportUndecodable(const std::string& reason) {
  TopicState& state = states_[raw_.topic];
  report_.damaged = true;
  report_.bytes_lost += raw_.bytes.size();
  if (++state.undecodable == 1) {
    state.first_reason = reason;
    state.undecodable_warning = report_.warnings.size();
    report_.warnings.emplace_back();
  }
  report_.warnings[state.undecodable_warning] =
      path_.string() + ": topic " + topics()[raw_.topic].name + ": " +
      CountOf(state.undecodable, "message is", "messages are") +
      " skipped, the first because it is " + state.first_reason;
}

void RosCloudReader::ReportOddity(const std::string& remark) {
  TopicState& state = states_[raw_.topic];
  if (state.oddity_reported) return;
  state.oddity_reported = true;
  report_.warnings.push_back(path_.string() + ": topic " + topics()[raw_.topic].name + ": " +
                             remark);
}

}  // namespace trajlo
