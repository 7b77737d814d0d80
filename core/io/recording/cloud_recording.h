// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "core/io/messages/cloud_message.h"
#include "core/io/recording/recording_options.h"
#include "core/io/scan_source.h"
#include "core/io/time_convention.h"

namespace trajlo {

/// The point clouds of a bag or of a capture as scans, in the order of recording: one LiDAR a
/// topic. The constructor finds the topics and decides the time convention of each from its first
/// messages; it throws InputError if that fails. After that no message can stop the reading.
class CloudRecording : public ScanSource {
 public:
  /// Opens the file anew: it is read once for evidence, and once for the scans.
  using Open = std::function<std::unique_ptr<CloudMessageReader>()>;

  /// `first_lidar_id` is that of the first topic in `options.topics`. With `read_ahead`, the next
  /// message is decoded in the background while the present scan is worked on.
  CloudRecording(const std::filesystem::path& path, const Open& open,
                 const RecordingOptions& options, std::size_t first_lidar_id = 0,
                 bool read_ahead = true);
  // The background decoding holds a pointer to this object.
  CloudRecording(const CloudRecording&) = delete;
  CloudRecording& operator=(const CloudRecording&) = delete;

  bool Next(LidarScan* scan) override;
  std::size_t size() const override { return report_.scans_listed; }
  const std::string& description() const override { return description_; }
  const ReadReport& report() const override { return report_; }

  /// How many LiDARs it has.
  std::size_t lidars() const { return streams_.size(); }
  const TimeConvention& time_convention(std::size_t lidar) const {
    return streams_[lidar].convention;
  }

 private:
  /// One LiDAR.
  struct Stream {
    std::size_t topic;
    TimeConvention convention;
    std::int64_t clock_offset_ns;
    int lidar_id;
    /// The headers' stamps are not filled: the time of recording stands for them.
    bool stamp_is_recorded;
  };
  /// What became of one message; nothing was left if `found` is false.
  struct Outcome {
    LidarScan scan;
    std::size_t points_without_time = 0;
    std::size_t points_undeclared = 0;
    bool found = false;
    bool readable = false;
    std::string damage;
  };

  void SelectStreams(const RecordingOptions& options, std::size_t first_lidar_id);
  void NoteTopic(const Topic& topic, std::size_t lidar_id);
  void Probe(CloudMessageReader* reader, const RecordingOptions& options);
  void Describe();
  Outcome Decode(LidarScan reused);
  void StartNext(LidarScan reused);
  void TakeOver(const MessageReport& message_report);

  std::filesystem::path path_;
  bool read_ahead_;
  std::unique_ptr<CloudMessageReader> reader_;
  std::vector<Stream> streams_;
  std::string description_;
  ReadReport report_;
  std::size_t warnings_taken_ = 0;
  /// Used by the background decoding only.
  CloudMessage message_;
  /// Declared last: its destructor waits for a decoding that uses the members above.
  std::future<Outcome> ahead_;
};

}  // namespace trajlo
