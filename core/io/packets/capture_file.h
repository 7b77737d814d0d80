// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/io/packets/datagram.h"
#include "core/io/packets/fragment_buffer.h"

struct pcap;

namespace trajlo {

/// What a pass over a capture found.
struct CaptureCounts {
  std::uint64_t frames = 0;
  std::uint64_t datagrams = 0;
  /// Frames of which less was captured than was sent (a snap length), or whose UDP header lies.
  std::uint64_t truncated = 0;
  /// Datagrams that lack IP fragments.
  std::uint64_t incomplete = 0;
  std::uint64_t bytes_lost = 0;
  /// Empty, or what is wrong with the file, with the offset.
  std::string damage;
};

/// The UDP datagrams of a file, one at a time: a capture (pcap or pcapng, through libpcap) or bare
/// Velodyne payloads of 1206 bytes one after the other. Opening throws InputError if it is
/// neither; afterwards a broken file only ends early, and `counts().damage` says so.
class CaptureFile {
 public:
  explicit CaptureFile(const std::filesystem::path& path);
  ~CaptureFile();
  CaptureFile(const CaptureFile&) = delete;
  CaptureFile& operator=(const CaptureFile&) = delete;

  bool Next(Datagram* datagram);
  /// Starts again from the beginning, counts included.
  void Rewind();
  const CaptureCounts& counts() const { return counts_; }
  /// Bare payloads: no addresses, no ports, no times.
  bool IsPayloadFile() const { return payloads_ != nullptr; }

 private:
  void Open();
  bool NextPayload(Datagram* datagram);
  bool NextFrame(Datagram* datagram);
  void Lose(const std::string& damage);

  struct PcapCloser {
    void operator()(pcap* capture) const;
  };
  struct FileCloser {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  std::filesystem::path path_;
  std::uint64_t file_size_ = 0;
  /// Where the last record that could be read ends.
  std::uint64_t good_until_ = 0;
  std::unique_ptr<pcap, PcapCloser> capture_;
  int link_type_ = 0;
  std::unique_ptr<std::FILE, FileCloser> payloads_;
  std::vector<std::uint8_t> payload_;
  FragmentBuffer fragments_;
  CaptureCounts counts_;
};

}  // namespace trajlo
