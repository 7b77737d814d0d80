// SPDX-License-Identifier: MIT
#include "core/io/conversion/bag_copy.h"

#include <algorithm>
#include <memory>
#include <optional>

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
  constexpr int kAllCores = 0;
  readers.reserve(bags.size());
  for (const auto& bag : bags) readers.push_back(std::make_unique<Ros1BagReader>(bag, kAllCores));
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

/// Copies what is wanted of bags that follow each other.
class Copier {
 public:
  Copier(const BagCopyOptions& options, std::size_t listed, Ros1BagWriter* writer)
      : options_(options), listed_(listed), writer_(writer) {}

  void Copy(Ros1BagReader* reader) {
    RawMessage message;
    while (reader->Next(&message)) {
      if (options_.should_stop && options_.should_stop()) break;
      if (options_.on_progress) options_.on_progress(++read_, listed_);
      if (!first_ns_) first_ns_ = message.recorded_ns;
      const std::int64_t since_start_ns = message.recorded_ns - *first_ns_ - options_.start_ns;
      if (since_start_ns < 0) continue;
      // Messages come in the order of recording, so that nothing later belongs to the excerpt.
      if (options_.duration_ns > 0 && since_start_ns >= options_.duration_ns) break;
      if (!IsWanted(reader->connection().topic, options_)) continue;
      writer_->Write(reader->connection(), message.recorded_ns, message.bytes.view());
      ++result_.messages;
    }
    ReportMerger().Take(reader->report(), &result_.report);
  }

  const BagCopyResult& result() const { return result_; }

 private:
  const BagCopyOptions& options_;
  std::size_t listed_;
  Ros1BagWriter* writer_;
  BagCopyResult result_;
  std::optional<std::int64_t> first_ns_;
  std::size_t read_ = 0;
};

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
  Copier copier(options, listed, &writer);
  for (auto& reader : readers) {
    copier.Copy(reader.get());
    reader.reset();
  }
  if (copier.result().messages == 0) {
    throw InputError(bags.front(), "no message lies in what is to be copied",
                     "Check --topics, --start_s and --duration_s with trajlo_info.");
  }
  writer.Close();
  return copier.result();
}

}  // namespace trajlo
