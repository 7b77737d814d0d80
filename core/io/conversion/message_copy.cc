// SPDX-License-Identifier: MIT
#include "core/io/conversion/message_copy.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "core/io/errors.h"
#include "core/io/messages/message_schema.h"
#include "core/io/messages/report_merger.h"
#include "core/io/recording/open_clouds.h"
#include "core/io/ros1/ros1_bag_reader.h"

namespace trajlo {
namespace {

constexpr int kAllCores = 0;

using Names = std::vector<std::string>;
/// Names and types, each name once.
using NamedTypes = std::vector<std::pair<std::string, std::string>>;

template <typename Readers>
NamedTypes TopicsOf(const Readers& readers) {
  NamedTypes topics;
  for (const auto& reader : readers) {
    for (const Topic& topic : reader->topics()) {
      const bool known = std::any_of(topics.begin(), topics.end(),
                                     [&](const auto& one) { return one.first == topic.name; });
      if (!known) topics.emplace_back(topic.name, topic.type);
    }
  }
  return topics;
}

/// Throws if a wanted topic is not there.
void CheckTopics(const std::filesystem::path& path, const NamedTypes& topics, const Names& wanted) {
  std::string there;
  for (const auto& [name, type] : topics) there += "\n    " + name + " (" + type + ")";
  for (const std::string& name : wanted) {
    const bool is_there = std::any_of(topics.begin(), topics.end(),
                                      [&](const auto& topic) { return topic.first == name; });
    if (is_there) continue;
    throw InputError(path, "no topic '" + name + "'; there are:" + there,
                     "Set --topics to some of these.");
  }
}

/// Walks through bags that follow each other, to what is wanted of them.
class Walk {
 public:
  template <typename Readers>
  Walk(const MessageCopyOptions& options, const Readers& readers) : options_(options) {
    for (const auto& reader : readers) {
      for (const Topic& topic : reader->topics()) listed_ += topic.messages;
    }
  }

  /// Calls `copy(topic, message)`. Nothing behind the excerpt belongs to it if messages are
  /// `in_order`: the rest of the bag is not read then.
  template <typename Copy>
  void Through(RawMessageReader* reader, bool in_order, MessageReport* report, Copy&& copy) {
    RawMessage message;
    while (reader->Next(&message)) {
      if (options_.should_stop && options_.should_stop()) break;
      if (++read_ == 1) first_ns_ = message.recorded_ns;
      if (options_.on_progress) options_.on_progress(read_, listed_);
      const std::int64_t since_start_ns = message.recorded_ns - first_ns_ - options_.start_ns;
      const bool is_behind = options_.duration_ns > 0 && since_start_ns >= options_.duration_ns;
      if (is_behind && in_order) break;
      if (since_start_ns < 0 || is_behind) continue;
      const Topic& topic = reader->topics()[message.topic];
      if (IsWanted(topic.name)) copy(topic, message);
    }
    ReportMerger().Take(reader->report(), report);
  }

 private:
  bool IsWanted(const std::string& topic) const {
    const Names& wanted = options_.topics;
    return wanted.empty() || std::find(wanted.begin(), wanted.end(), topic) != wanted.end();
  }

  const MessageCopyOptions& options_;
  std::size_t listed_ = 0, read_ = 0;
  std::int64_t first_ns_ = 0;
};

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
    route.obstacle = "its messages are not ROS messages: " + topic.type;
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

/// Writes the messages of one bag into another of any kind.
class Router {
 public:
  Router(BagWriter* writer, MessageCopyResult* result) : writer_(writer), result_(result) {}

  void Copy(const Topic& topic, const RawMessage& message) {
    auto known = routes_.find(message.topic);
    if (known == routes_.end()) {
      known = routes_.emplace(message.topic, MakeRoute(topic, writer_->encoding())).first;
    }
    const Route& route = known->second;
    if (!route.obstacle.empty()) {
      result_->left_out[topic.name] = route.obstacle;
      return;
    }
    if (!route.schema) {
      writer_->Write(route.topic, message.recorded_ns, message.bytes.view());
    } else {
      const auto rewritten =
          route.schema->Rewrite(message.bytes.view(), topic.encoding, writer_->encoding());
      if (!rewritten) {
        result_->report.damaged = true;
        result_->left_out[topic.name] = "messages that do not agree with " + topic.type;
        return;
      }
      writer_->Write(route.topic, message.recorded_ns, *rewritten);
    }
    ++result_->messages;
  }

 private:
  BagWriter* writer_;
  MessageCopyResult* result_;
  std::map<std::size_t, Route> routes_;
};

}  // namespace

MessageCopyResult CopyBags(const std::vector<std::filesystem::path>& bags,
                           const std::filesystem::path& output, const MessageCopyOptions& options,
                           const Ros1BagOptions& bag) {
  std::vector<std::unique_ptr<Ros1BagReader>> readers;
  for (const auto& path : bags) readers.push_back(std::make_unique<Ros1BagReader>(path, kAllCores));
  CheckTopics(bags.front(), TopicsOf(readers), options.topics);
  Ros1BagWriter writer(output, bag);
  MessageCopyResult result;
  Walk walk(options, readers);
  for (auto& reader : readers) {
    constexpr bool kInOrder = true;
    walk.Through(reader.get(), kInOrder, &result.report,
                 [&](const Topic&, const RawMessage& message) {
                   writer.Write(reader->connection(), message.recorded_ns, message.bytes.view());
                   ++result.messages;
                 });
    reader.reset();
  }
  if (result.messages == 0) {
    throw InputError(bags.front(), "there is no message in the part to copy",
                     "Check --topics, --start_s and --duration_s with trajlo_info.");
  }
  writer.Close();
  return result;
}

MessageCopyResult CopyMessages(const std::filesystem::path& path, const MessageCopyOptions& options,
                               BagWriter* writer) {
  const std::vector<std::filesystem::path> parts = BagsOf(path);
  std::vector<std::unique_ptr<RawMessageReader>> readers;
  for (const auto& part : parts) readers.push_back(OpenMessages(part, kAllCores));
  NamedTypes topics = TopicsOf(readers);
  std::sort(topics.begin(), topics.end());
  CheckTopics(path, topics, options.topics);
  MessageCopyResult result;
  Walk walk(options, readers);
  for (auto& reader : readers) {
    Router router(writer, &result);
    constexpr bool kInOrder = false;  // Files of ROS 2 need not be in the order of time.
    walk.Through(
        reader.get(), kInOrder, &result.report,
        [&](const Topic& topic, const RawMessage& message) { router.Copy(topic, message); });
    reader.reset();
  }
  return result;
}

}  // namespace trajlo
