// SPDX-License-Identifier: MIT
#include "core/io/ros2/rosbag2_reader.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>

#include "core/io/errors.h"
#include "core/io/random_access_file.h"
#include "core/io/ros2/db3_reader.h"
#include "core/io/ros2/mcap_reader.h"
#include "core/io/ros2/mcap_records.h"
#include "core/io/ros2/rosbag2_metadata.h"
#include "core/io/ros2/unpack.h"

namespace trajlo {
namespace {

/// Told by the first bytes; by the name only of a file that begins like neither kind.
bool IsMcap(const std::filesystem::path& path, const std::filesystem::path& name) {
  constexpr std::string_view kSqliteMark = "SQLite format 3";
  const FileBytes first = RandomAccessFile(path).Read(0, kSqliteMark.size());
  if (first.view().substr(0, kMcapMagic.size()) == kMcapMagic) return true;
  return first.view() != kSqliteMark && name.extension() == ".mcap";
}

std::unique_ptr<RawMessageReader> OpenPlain(const std::filesystem::path& path,
                                            const std::filesystem::path& shown,
                                            const std::filesystem::path& name) {
  if (IsMcap(path, name)) return std::make_unique<McapReader>(path, shown);
  return std::make_unique<Db3Reader>(path, shown);
}

void Warn(const std::string& sentence, MessageReport* report) {
  report->damaged = true;
  report->warnings.push_back(sentence);
}

std::unique_ptr<RawMessageReader> OpenFile(const std::filesystem::path& path,
                                           MessageReport* report) {
  if (path.extension() != ".zstd") return OpenPlain(path, path, path);
  std::string problem;
  // An open file stays readable when its name is gone.
  const TempFile unpacked = UnpackFile(path, &problem);
  auto reader = OpenPlain(unpacked.path(), path, path.stem());
  if (!problem.empty()) {
    Warn(path.string() + ": unpacking ended too early: " + problem, report);
  }
  return reader;
}

std::size_t FindTopic(const std::vector<Topic>& topics, const Topic& wanted) {
  const auto found = std::find_if(topics.begin(), topics.end(), [&](const Topic& topic) {
    return topic.name == wanted.name && topic.type == wanted.type &&
           topic.encoding == wanted.encoding;
  });
  return static_cast<std::size_t>(found - topics.begin());
}

}  // namespace

Rosbag2Reader::Rosbag2Reader(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) {
    Rosbag2Folder folder = ReadRosbag2Folder(path);
    files_ = std::move(folder.files);
    topics_ = std::move(folder.topics);
    if (!folder.problem.empty()) report_.warnings.push_back(path.string() + ": " + folder.problem);
  } else {
    files_ = {path};
  }
  if (files_.size() == 1) {
    current_ = OpenFile(files_.front(), &report_);
    next_file_ = 1;
    topics_ = current_->topics();
    topic_of_.resize(topics_.size());
    std::iota(topic_of_.begin(), topic_of_.end(), std::size_t{0});
  } else {
    if (topics_.empty()) MergeTopicsOfAllFiles();
    selected_.resize(topics_.size());
    std::iota(selected_.begin(), selected_.end(), std::size_t{0});
    OpenNextFile();
  }
  if (!current_) {
    throw InputError(path, "none of its " + std::to_string(files_.size()) + " files can be read",
                     report_.warnings.empty() ? "" : report_.warnings.back());
  }
}

void Rosbag2Reader::MergeTopicsOfAllFiles() {
  for (const auto& file : files_) {
    MessageReport unused;  // Reading the messages will report the same.
    try {
      const auto reader = OpenFile(file, &unused);
      for (const Topic& topic : reader->topics()) {
        const std::size_t known = FindTopic(topics_, topic);
        if (known == topics_.size()) topics_.push_back({topic.name, topic.type, topic.encoding, 0});
        topics_[known].messages += topic.messages;
      }
    } catch (const InputError&) {
    }
  }
}

void Rosbag2Reader::OpenNextFile() {
  current_.reset();
  while (!current_ && next_file_ < files_.size()) {
    try {
      current_ = OpenFile(files_[next_file_++], &report_);
    } catch (const InputError& error) {
      Warn(error.what(), &report_);
    }
  }
  if (!current_) return;
  merger_ = {};
  topic_of_.clear();
  for (const Topic& topic : current_->topics()) {
    topic_of_.push_back(FindTopic(topics_, topic));
    if (topic_of_.back() == topics_.size()) continue;
    // What metadata.yaml does not tell.
    Topic& ours = topics_[topic_of_.back()];
    if (ours.interface.definition.empty()) ours.interface = topic.interface;
    if (ours.qos.empty()) ours.qos = topic.qos;
    ours.is_latched = ours.is_latched || topic.is_latched;
  }
  Select(selected_);
}

void Rosbag2Reader::Select(const std::vector<std::size_t>& topics) {
  selected_ = topics;
  std::vector<std::size_t> of_file;
  for (std::size_t i = 0; i < topic_of_.size(); ++i) {
    if (std::find(topics.begin(), topics.end(), topic_of_[i]) != topics.end()) of_file.push_back(i);
  }
  if (current_) current_->Select(of_file);
}

bool Rosbag2Reader::Next(RawMessage* message) {
  while (current_) {
    const bool got = current_->Next(message);
    merger_.Take(current_->report(), &report_);
    if (got) {
      message->topic = topic_of_[message->topic];
      return true;
    }
    OpenNextFile();
  }
  return false;
}

bool IsRos2Bag(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(path, ignored)) return IsRosbag2File(path);
  for (const auto& entry : std::filesystem::directory_iterator(path, ignored)) {
    if (entry.path().filename() == "metadata.yaml" || IsRosbag2File(entry.path())) return true;
  }
  return false;
}

}  // namespace trajlo
