// SPDX-License-Identifier: MIT
#include "core/io/packets/capture_file.h"

#include <pcap/pcap.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "core/io/errors.h"
#include "core/io/format_text.h"
#include "core/io/packets/byte_order.h"
#include "core/io/packets/ip_packet.h"
#include "core/io/packets/velodyne_packet.h"
#include "core/io/velodyne_payloads.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

/// The year 2106: 32 bits of seconds. What is later is a broken number, and sums of times must not
/// overflow.
constexpr std::int64_t kLatestS = 0xffffffff;

std::int64_t CapturedNs(const pcap_pkthdr& header) {
  const std::int64_t seconds = std::clamp<std::int64_t>(header.ts.tv_sec, 0, kLatestS);
  const std::int64_t ns = std::clamp<std::int64_t>(header.ts.tv_usec, 0, 999'999'999);
  return seconds * kNsPerSecond + ns;
}

}  // namespace

void CaptureFile::PcapCloser::operator()(pcap* capture) const { pcap_close(capture); }

CaptureFile::CaptureFile(const std::filesystem::path& path) : path_(path) { Open(); }

CaptureFile::~CaptureFile() = default;

void CaptureFile::Open() {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path_, error)) {
    throw InputError(path_, error ? error.message() : "this is not a regular file",
                     "Give the capture file itself.");
  }
  file_size_ = std::filesystem::file_size(path_, error);
  std::unique_ptr<std::FILE, FileCloser> file(std::fopen(path_.c_str(), "rbe"));
  if (file == nullptr) {
    throw InputError(path_, std::string("opening failed: ") + std::strerror(errno),
                     "Check that the file exists and that you may read it.");
  }
  char head[kVelodynePacketSize];
  const std::size_t got = std::fread(head, 1, sizeof head, file.get());
  std::rewind(file.get());
  if (BeginsAsVelodynePayloads({head, got})) {
    payloads_ = std::move(file);
    payload_.resize(kVelodynePacketSize);
    return;
  }
  char message[PCAP_ERRBUF_SIZE] = "";
  capture_.reset(
      pcap_fopen_offline_with_tstamp_precision(file.get(), PCAP_TSTAMP_PRECISION_NANO, message));
  if (capture_ == nullptr) {
    throw InputError(path_, std::string("libpcap cannot read this as a packet capture: ") + message,
                     "Give a .pcap or .pcapng file (not compressed), or Velodyne payloads of 1206 "
                     "bytes one after the other.");
  }
  static_cast<void>(file.release());  // libpcap closes it now.
  link_type_ = pcap_datalink(capture_.get());
  if (!IsKnownLinkType(link_type_)) {
    const char* name = pcap_datalink_val_to_name(link_type_);
    throw InputError(path_,
                     "frames of link type " + std::to_string(link_type_) + " (" +
                         (name != nullptr ? name : "unknown") + ") are not supported",
                     "Known are Ethernet, Linux cooked captures, raw IP and BSD loopback.");
  }
  good_until_ = static_cast<std::uint64_t>(std::max<off_t>(ftello(pcap_file(capture_.get())), 0));
}

void CaptureFile::Rewind() {
  capture_.reset();
  payloads_.reset();
  fragments_ = {};
  counts_ = {};
  good_until_ = 0;
  Open();
}

void CaptureFile::Lose(const std::string& damage) {
  counts_.bytes_lost = file_size_ - std::min(good_until_, file_size_);
  counts_.damage = damage + " at byte " + std::to_string(good_until_) + " of " +
                   std::to_string(file_size_) + ": " + CountOf(counts_.bytes_lost, "byte") +
                   " lost";
}

bool CaptureFile::Next(Datagram* datagram) {
  if (!counts_.damage.empty()) return false;
  return IsPayloadFile() ? NextPayload(datagram) : NextFrame(datagram);
}

bool CaptureFile::NextPayload(Datagram* datagram) {
  const std::size_t got = std::fread(payload_.data(), 1, payload_.size(), payloads_.get());
  if (got < payload_.size()) {
    if (got > 0) Lose("the file ends inside a packet");
    return false;
  }
  good_until_ += got;
  ++counts_.frames;
  ++counts_.datagrams;
  *datagram = {};
  datagram->data = payload_.data();
  datagram->size = got;
  return true;
}

bool CaptureFile::NextFrame(Datagram* datagram) {
  pcap_pkthdr* header = nullptr;
  const u_char* bytes = nullptr;
  for (;;) {
    const int result = pcap_next_ex(capture_.get(), &header, &bytes);
    if (result != 1) {
      if (result == PCAP_ERROR) {
        Lose(std::string("reading stopped (libpcap: ") + pcap_geterr(capture_.get()) + ")");
      }
      return false;
    }
    good_until_ = static_cast<std::uint64_t>(std::max<off_t>(ftello(pcap_file(capture_.get())), 0));
    ++counts_.frames;
    IpPacket packet;
    const FrameContent content = ParseFrame(link_type_, bytes, header->caplen, &packet);
    if (content == FrameContent::kOther) continue;
    if (content == FrameContent::kTruncated) {
      ++counts_.truncated;
      continue;
    }
    const std::int64_t captured_ns = CapturedNs(*header);
    if (content == FrameContent::kFragment) {
      const std::vector<std::uint8_t>* whole = fragments_.Add(packet, captured_ns);
      counts_.incomplete = fragments_.incomplete();
      if (whole == nullptr) continue;
      packet.data = whole->data();
      packet.size = whole->size();
    }
    datagram->captured_ns = captured_ns;
    datagram->source = packet.source;
    if (!ParseUdp(packet.data, packet.size, datagram)) {
      ++counts_.truncated;
      continue;
    }
    ++counts_.datagrams;
    return true;
  }
}

}  // namespace trajlo
