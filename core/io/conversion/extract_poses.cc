// SPDX-License-Identifier: MIT
#include "core/io/conversion/extract_poses.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "core/io/errors.h"
#include "core/io/format_text.h"
#include "core/io/messages/pose_decoder.h"
#include "core/io/messages/report_merger.h"
#include "core/io/recording/open_clouds.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);
/// A year after 1970.
constexpr std::int64_t kEarliestDate_ns = 365 * 86'400 * kNsPerSecond;

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

/// The poses of one topic as they come, and what is odd about them.
class PoseCollector {
 public:
  PoseCollector(const std::filesystem::path& recording, const std::string& topic)
      : name_(recording.string() + ": " + topic + ": ") {}

  void Add(const StampedPose& pose, std::int64_t recorded_ns) {
    poses_.push_back(pose);
    recorded_ns_.push_back(recorded_ns);
  }

  void Finish(ExtractedPoses* extracted) {
    MendStamps(extracted);
    MendRotations(extracted);
    Order(extracted);
    extracted->poses = std::move(poses_);
  }

 private:
  void Warn(const std::string& sentence, ExtractedPoses* extracted) const {
    extracted->report.warnings.push_back(name_ + sentence);
  }

  template <typename IsBad>
  std::size_t Remove(const IsBad& is_bad, ExtractedPoses* extracted) {
    const std::size_t before = poses_.size();
    poses_.erase(std::remove_if(poses_.begin(), poses_.end(), is_bad), poses_.end());
    extracted->unreadable += before - poses_.size();
    return before - poses_.size();
  }

  /// As with clouds, the time of recording stands for stamps that nobody filled.
  void MendStamps(ExtractedPoses* extracted) {
    const auto latest = std::max_element(poses_.begin(), poses_.end(), IsEarlier);
    if (latest == poses_.end()) return;
    if (latest->t_ns == 0) {
      for (std::size_t i = 0; i < poses_.size(); ++i) poses_[i].t_ns = recorded_ns_[i];
      Warn(
          "the stamps are zero, and the times of recording stand for them: they come late, by "
          "what it took to send and to record",
          extracted);
      return;
    }
    // Where the other stamps are dates, and not those of a simulation that begins at zero.
    if (latest->t_ns < kEarliestDate_ns) return;
    const std::size_t zero =
        Remove([](const StampedPose& pose) { return pose.t_ns == 0; }, extracted);
    if (zero > 0) Warn(CountOf(zero, "pose has", "poses have") + " the stamp zero", extracted);
  }

  void MendRotations(ExtractedPoses* extracted) {
    const auto without = [](const StampedPose& pose) { return !pose.has_rotation; };
    if (std::all_of(poses_.begin(), poses_.end(), without)) {
      if (poses_.empty()) return;
      Warn("positions without rotations: the identity stands for each, and angles mean nothing",
           extracted);
      return;
    }
    const std::size_t zero = Remove(without, extracted);
    if (zero > 0) Warn(CountOf(zero, "pose has", "poses have") + " a zero quaternion", extracted);
  }

  void Order(ExtractedPoses* extracted) {
    std::size_t backward = 0;
    for (std::size_t i = 1; i < poses_.size(); ++i) {
      backward += IsEarlier(poses_[i], poses_[i - 1]) ? 1 : 0;
    }
    if (backward > 0) {
      Warn(CountOf(backward, "stamp is", "stamps are") +
               " earlier than the one before; the poses are sorted by time",
           extracted);
    }
    std::stable_sort(poses_.begin(), poses_.end(), IsEarlier);
    std::vector<StampedPose> once;
    for (const StampedPose& pose : poses_) {
      if (once.empty() || once.back().t_ns != pose.t_ns) {
        once.push_back(pose);
      } else if (pose.T_world_body.t != once.back().T_world_body.t ||
                 pose.T_world_body.q.coeffs() != once.back().T_world_body.q.coeffs()) {
        ++extracted->contradicted;
      }
    }
    const std::size_t repeated = poses_.size() - once.size();
    poses_ = std::move(once);
    if (repeated == 0) return;
    std::string sentence = CountOf(repeated, "stamp repeats", "stamps repeat") + " an earlier one";
    if (extracted->contradicted > 0) {
      sentence += ", " + std::to_string(extracted->contradicted) + " of them with another pose";
    }
    Warn(sentence + "; what was recorded first counts", extracted);
  }

  static bool IsEarlier(const StampedPose& a, const StampedPose& b) { return a.t_ns < b.t_ns; }

  std::string name_;
  std::vector<StampedPose> poses_;
  std::vector<std::int64_t> recorded_ns_;
};

}  // namespace

ExtractedPoses ExtractPoses(const std::filesystem::path& recording, const std::string& topic) {
  const std::vector<std::filesystem::path> parts = BagsOf(recording);
  ExtractedPoses extracted;
  PoseCollector collector(recording, topic);
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
        collector.Add(*pose, message.recorded_ns);
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
  collector.Finish(&extracted);
  if (extracted.poses.empty()) {
    throw InputError(recording, "no message of " + topic + " holds a pose", "");
  }
  return extracted;
}

}  // namespace trajlo
