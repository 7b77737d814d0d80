// SPDX-License-Identifier: MIT
#include "core/io/conversion/message_copy.h"

#include <algorithm>
#include <memory>
#include <optional>

#include "core/io/errors.h"
#include "core/io/messages/message_schema.h"
#include "core/io/messages/report_merger.h"
#include "core/io/recording/open_clouds.h"

namespace trajlo {
namespace {

using Readers = std::vector<std::unique_ptr<RawMessageReader>>;

Readers OpenAll(const std::filesystem::path& path) {
  constexpr int kAllCores = 0;
  std::vector<std::filesystem::path> parts = Ros1BagsOf(path);
  if (parts.empty()) parts.push_back(path);
  Readers readers;
  for (const auto& part : parts) readers.push_back(OpenMessages(part, kAllCores));
  return readers;
}

/// Throws if a wanted topic is in none of the bags.
void CheckTopics(const std::filesystem::path& path, const Readers& readers,
                 const std::vector<std::string>& wanted) {
  std::map<std::string, std::string> types;
  for (const auto& reader : readers) {
    for (const Topic& topic : reader->topics()) types.emplace(topic.name, topic.type);
  }
  std::string there;
  for (const auto& [name, type] : types) there += "\n    " + name + " (" + type + ")";
  for (const std::string& name : wanted) {
    if (types.count(name) > 0) continue;
    throw InputError(path, "no topic '" + name + "'; there are:" + there,
                     "Set --topics to some of these.");
  }
}

/// How the messages of a topic get into the other bag.
struct Route {
  TopicDescription topic;
  /// Nothing: as they are.
  std::optional<MessageSchema> schema;
  /// Why they cannot; empty if they can.
  std::string obstacle;
};

Route MakeRoute(const Topic& topic, Encoding to) {
  Route route;
  MessageDescription interface = topic.interface;
  interface.type = topic.type;
  if (topic.type.find('(') != std::string::npos) {
    route.obstacle = "its messages are no ROS messages: " + topic.type;
    return route;
  }
  // Interfaces that we know ourselves, where the bag does not tell.
  const MessageDescription* known = FindDescription(topic.type);
  if (known != nullptr && (interface.definition.empty() || to == Encoding::kRos1)) {
    interface = *known;
  }
  if (to == Encoding::kRos1 && interface.md5sum.empty()) {
    route.obstacle = "the interface of " + topic.type + " in ROS 1 is not known";
  } else if (topic.encoding != to) {
    route.schema = MessageSchema::Parse(interface.type, interface.definition);
    if (!route.schema) {
      route.obstacle = "the bag does not tell the whole interface of " + topic.type;
    }
  }
  // Between ROS 1 and ROS 2 the qualities of service are those that latching means.
  const bool same_ros = topic.encoding == to;
  route.topic = {topic.name, interface, topic.is_latched, same_ros ? topic.qos : ""};
  return route;
}

class Copier {
 public:
  Copier(const MessageCopyOptions& options, std::size_t listed, BagWriter* writer)
      : options_(options), listed_(listed), writer_(writer) {}

  void Copy(RawMessageReader* reader) {
    routes_.clear();
    RawMessage message;
    while (reader->Next(&message)) {
      if (options_.should_stop && options_.should_stop()) break;
      if (options_.on_progress) options_.on_progress(++read_, listed_);
      if (!first_ns_) first_ns_ = message.recorded_ns;
      const std::int64_t since_start_ns = message.recorded_ns - *first_ns_ - options_.start_ns;
      if (since_start_ns < 0) continue;
      const bool is_behind = options_.duration_ns > 0 && since_start_ns >= options_.duration_ns;
      if (is_behind) continue;  // Files of ROS 2 need not be in the order of time.
      CopyOne(reader->topics()[message.topic], message);
    }
    ReportMerger().Take(reader->report(), &result_.report);
  }

  const MessageCopyResult& result() const { return result_; }

 private:
  void CopyOne(const Topic& topic, const RawMessage& message) {
    const std::vector<std::string>& wanted = options_.topics;
    const bool is_wanted =
        wanted.empty() || std::find(wanted.begin(), wanted.end(), topic.name) != wanted.end();
    if (!is_wanted) return;
    auto route = routes_.find(message.topic);
    if (route == routes_.end()) {
      route = routes_.emplace(message.topic, MakeRoute(topic, writer_->encoding())).first;
    }
    if (!route->second.obstacle.empty()) {
      result_.left_out[topic.name] = route->second.obstacle;
      return;
    }
    if (!route->second.schema) {
      writer_->Write(route->second.topic, message.recorded_ns, message.bytes.view());
    } else {
      const auto rewritten =
          route->second.schema->Rewrite(message.bytes.view(), topic.encoding, writer_->encoding());
      if (!rewritten) {
        result_.report.damaged = true;
        result_.left_out[topic.name] = "messages that do not agree with " + topic.type;
        return;
      }
      writer_->Write(route->second.topic, message.recorded_ns, *rewritten);
    }
    ++result_.messages;
  }

  const MessageCopyOptions& options_;
  std::size_t listed_;
  BagWriter* writer_;
  MessageCopyResult result_;
  std::map<std::size_t, Route> routes_;
  std::optional<std::int64_t> first_ns_;
  std::size_t read_ = 0;
};

}  // namespace

MessageCopyResult CopyMessages(const std::filesystem::path& path, const MessageCopyOptions& options,
                               BagWriter* writer) {
  Readers readers = OpenAll(path);
  CheckTopics(path, readers, options.topics);
  std::size_t listed = 0;
  for (const auto& reader : readers) {
    for (const Topic& topic : reader->topics()) listed += topic.messages;
  }
  Copier copier(options, listed, writer);
  for (auto& reader : readers) {
    copier.Copy(reader.get());
    reader.reset();
  }
  return copier.result();
}

}  // namespace trajlo
