// SPDX-License-Identifier: MIT
#include "core/io/conversion/extract_poses.h"

#include <memory>

#include "core/io/errors.h"
#include "core/io/format_text.h"
#include "core/io/messages/pose_decoder.h"
#include "core/io/messages/report_merger.h"
#include "core/io/recording/open_clouds.h"

namespace trajlo {
namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

/// The place of the topic; kNone if it is not there, and `others` grows by the topics with poses.
std::size_t FindTopic(const RawMessageReader& reader, const std::string& name,
                      std::string* others) {
  std::size_t found = kNone;
  for (std::size_t i = 0; i < reader.topics().size(); ++i) {
    const Topic& topic = reader.topics()[i];
    if (!IsPoseType(topic.type)) continue;
    if (topic.name == name) found = i;
    *others +=
        "\n    " + topic.name + " (" + topic.type + ", " + CountOf(topic.messages, "message") + ")";
  }
  return found;
}

}  // namespace

ExtractedPoses ExtractPoses(const std::filesystem::path& recording, const std::string& topic) {
  const std::vector<std::filesystem::path> parts = BagsOf(recording);
  ExtractedPoses extracted;
  std::string others;
  bool found = false;
  for (const std::filesystem::path& part : parts) {
    constexpr int kAllCores = 0;
    const std::unique_ptr<RawMessageReader> reader = OpenMessages(part, kAllCores);
    const std::size_t place = FindTopic(*reader, topic, &others);
    if (place == kNone) continue;
    found = true;
    reader->Select({place});
    const Topic& listed = reader->topics()[place];
    RawMessage message;
    while (reader->Next(&message)) {
      const auto pose = DecodePose(listed.type, listed.encoding, message.bytes.view());
      if (pose) {
        extracted.poses.push_back(*pose);
      } else {
        ++extracted.unreadable;
      }
    }
    ReportMerger().Take(reader->report(), &extracted.report);
  }
  if (!found) {
    throw InputError(
        recording,
        "no topic '" + topic + "' with poses; there are:" + (others.empty() ? " none" : others),
        "Set --poses to one of these.");
  }
  if (extracted.poses.empty()) {
    throw InputError(recording, "no message of " + topic + " holds a pose", "");
  }
  return extracted;
}

}  // namespace trajlo
