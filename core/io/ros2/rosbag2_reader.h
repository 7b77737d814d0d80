// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <vector>

#include "core/io/messages/raw_message.h"
#include "core/io/messages/report_merger.h"

namespace trajlo {

/// The files of one rosbag2 recording one after the other: a folder with metadata.yaml (or without,
/// after a killed recorder) whose files are .db3 or .mcap, or one such file; each may be compressed
/// as a whole (.zstd), and is then unpacked into the folder for temporary files while it is read.
/// A file that is missing or unreadable is reported and passed over.
class Rosbag2Reader final : public RawMessageReader {
 public:
  /// Takes a file or a folder.
  explicit Rosbag2Reader(const std::filesystem::path& path);

  const std::vector<Topic>& topics() const override { return topics_; }
  void Select(const std::vector<std::size_t>& topics) override;
  bool Next(RawMessage* message) override;
  const MessageReport& report() const override { return report_; }

 private:
  void MergeTopicsOfAllFiles();
  void OpenNextFile();

  std::vector<std::filesystem::path> files_;
  std::size_t next_file_ = 0;
  std::vector<Topic> topics_;
  std::vector<std::size_t> selected_;
  std::unique_ptr<RawMessageReader> current_;
  /// For each topic of the current file, which of ours it is.
  std::vector<std::size_t> topic_of_;
  ReportMerger merger_;
  MessageReport report_;
};

/// True for what Rosbag2Reader takes, by the names: .db3, .mcap, either with .zstd behind it, or a
/// folder with such files or a metadata.yaml.
bool IsRos2Bag(const std::filesystem::path& path);

}  // namespace trajlo
