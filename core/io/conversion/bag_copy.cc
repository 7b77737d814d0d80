// SPDX-License-Identifier: MIT
#include "core/io/conversion/bag_copy.h"

#include <algorithm>
#include <memory>
#include <optional>

#include "core/io/conversion/bag_definitions.h"
#include "core/io/errors.h"
#include "core/io/messages/report_merger.h"
#include "core/io/ros1/ros1_bag_reader.h"

namespace trajlo {
namespace {

bool IsWanted(const std::string& topic, const BagCopyOptions& options) {
  return options.topics.empty() ||
         std::find(options.topics.begin(), options.topics.end(), topic) != options.topics.end();
}

std::vector<std::unique_ptr<Ros1BagReader>> OpenAll(
    const std::vector<std::filesystem::path>& bags) {
  std::vector<std::unique_ptr<Ros1BagReader>> readers;
  for (const auto& bag : bags) readers.push_back(std::make_unique<Ros1BagReader>(bag));
  return readers;
}

/// Throws if a wanted topic is in none of the bags.
void CheckTopics(const std::filesystem::path& path,
                 const std::vector<std::unique_ptr<Ros1BagReader>>& readers,
                 const std::vector<std::string>& wanted) {
  std::string there;
  std::vector<std::string> names;
  for (const auto& reader : readers) {
    for (const Topic& topic : reader->topics()) {
      if (std::find(names.begin(), names.end(), topic.name) != names.end()) continue;
      names.push_back(topic.name);
      there += "\n    " + topic.name + " (" + topic.type + ")";
    }
  }
  for (const std::string& name : wanted) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    throw InputError(path, "no topic '" + name + "'; there are:" + there,
                     "Set --topics to some of these.");
  }
}

}  // namespace

BagCopyResult CopyBags(const std::vector<std::filesystem::path>& bags,
                       const std::filesystem::path& output, const BagCopyOptions& options) {
  auto readers = OpenAll(bags);
  CheckTopics(bags.front(), readers, options.topics);
  std::size_t listed = 0;
  for (const auto& reader : readers) {
    for (const Topic& topic : reader->topics()) listed += topic.messages;
  }
  Ros1BagWriter writer(output, options.output);
  BagCopyResult result;
  std::optional<std::int64_t> first_ns;
  std::size_t read = 0;
  for (std::size_t i = 0; i < bags.size(); ++i) {
    Ros1BagReader& reader = *readers[i];
    const auto definitions = ReadBagDefinitions(bags[i]);
    RawMessage message;
    ReportMerger merger;
    while (reader.Next(&message)) {
      if (options.should_stop && options.should_stop()) break;
      if (options.on_progress) options.on_progress(++read, listed);
      if (!first_ns) first_ns = message.recorded_ns;
      const std::int64_t since_start_ns = message.recorded_ns - *first_ns - options.start_ns;
      if (since_start_ns < 0) continue;
      // Messages come in the order of recording, so that nothing later belongs to the excerpt.
      if (options.duration_ns > 0 && since_start_ns >= options.duration_ns) break;
      const Topic& topic = reader.topics()[message.topic];
      if (!IsWanted(topic.name, options)) continue;
      const auto found = definitions.find({topic.name, topic.type});
      const BagDefinition definition = found == definitions.end() ? BagDefinition() : found->second;
      writer.Write(topic.name,
                   {topic.type.c_str(), definition.md5sum.c_str(), definition.definition.c_str()},
                   message.recorded_ns, message.bytes.view());
      ++result.messages;
    }
    merger.Take(reader.report(), &result.report);
    readers[i].reset();
  }
  if (result.messages == 0) {
    throw InputError(bags.front(), "no message lies in what is to be copied",
                     "Check --topics, --start_s and --duration_s with trajlo_info.");
  }
  writer.Close();
  return result;
}

}  // namespace trajlo
