// SPDX-License-Identifier: MIT
#include "core/io/packets/capture_survey.h"

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <tuple>
#include <utility>

#include "core/io/errors.h"
#include "core/io/packets/ouster_stream.h"
#include "core/io/packets/velodyne_stream.h"
#include "core/scans/median.h"

namespace trajlo {
namespace {

using Kind = PacketStream::Kind;

/// Streams beyond that are lumped together: a scan of all ports is no recording.
constexpr std::size_t kMostStreams = 64;
constexpr std::size_t kOusterImuSize = 48;
constexpr std::size_t kClockSamples = 1000;

/// The metadata and, where none was found, what was tried.
struct MetadataSet {
  std::vector<OusterMetadata> metadata;
  std::vector<OusterLayout> layouts;
  std::string failures;

  void Add(OusterMetadata one) {
    const std::optional<OusterLayout> layout = LayoutOf(one);
    if (!layout) {
      throw InputError(one.path, "the lidar packets' profile " + one.profile + " is not supported",
                       "Known profiles: " + KnownOusterProfiles() + ".");
    }
    metadata.push_back(std::move(one));
    layouts.push_back(*layout);
  }
};

MetadataSet LoadMetadata(const std::filesystem::path& capture, const PacketOptions& options) {
  MetadataSet set;
  for (const auto& path : options.ouster_metadata) set.Add(ReadOusterMetadata(path));
  if (!options.ouster_metadata.empty()) return set;
  // What only lies beside the capture may be something else.
  for (const auto& path : FindOusterMetadata(capture)) {
    try {
      set.Add(ReadOusterMetadata(path));
    } catch (const InputError& error) {
      set.failures += std::string(set.failures.empty() ? "" : "; ") + error.what();
    }
  }
  return set;
}

class Surveyor {
 public:
  Surveyor(const std::filesystem::path& path, const PacketOptions& options)
      : path_(path), options_(options), set_(LoadMetadata(path, options)) {}

  void Add(const Datagram& packet) {
    if (IsVelodynePacket(packet.data, packet.size)) return AddVelodyne(packet);
    if (AddOuster(packet)) return;
    if (packet.captured_ns && gps_ahead_ns_.count(packet.source) == 0) {
      const std::optional<std::int64_t> gps_ns = GprmcTimeNs(packet.data, packet.size);
      if (gps_ns) gps_ahead_ns_[packet.source] = *gps_ns - *packet.captured_ns;
    }
    Study& study = Find(Kind::kOther, packet.port, {});
    ++study.stream.datagrams;
    const bool imu = packet.size == kOusterImuSize && !set_.metadata.empty();
    if (!imu && !IsVelodynePositionPacket(packet.data, packet.size)) ++study.stream.foreign;
    if (LooksLikeOuster(packet)) study.stream.problem = MissingMetadata();
  }

  CaptureSurvey Finish() {
    CaptureSurvey survey;
    for (Study& study : studies_) {
      if (study.stream.kind == Kind::kVelodyne) FinishVelodyne(&study);
      if (study.stream.kind == Kind::kOuster) FinishOuster(&study);
      survey.streams.push_back(std::move(study.stream));
    }
    survey.metadata = std::move(set_.metadata);
    return survey;
  }

 private:
  struct Study {
    PacketStream stream;
    std::unique_ptr<SweepStream> counter;
    /// By VelodyneModel.
    std::array<std::uint64_t, 4> votes{};
    VelodyneKind kind;
    VelodyneModel counted_as = VelodyneModel::kVlp16;
    std::vector<std::int64_t> capture_offsets_ns;
  };

  Study& Find(Kind kind, std::uint16_t port, const IpAddress& source) {
    const auto key = std::make_tuple(kind, port, source);
    const auto at = by_key_.find(key);
    if (at != by_key_.end()) return studies_[at->second];
    if (kind == Kind::kOther && studies_.size() >= kMostStreams && port != 0) {
      return Find(kind, 0, source);
    }
    by_key_[key] = studies_.size();
    studies_.emplace_back();
    PacketStream& stream = studies_.back().stream;
    stream.kind = kind;
    stream.port = port;
    stream.source = source;
    return studies_.back();
  }

  void AddVelodyne(const Datagram& packet) {
    Study& study = Find(Kind::kVelodyne, packet.port, packet.source);
    ++study.stream.datagrams;
    const VelodyneKind kind = KindOf(packet.data);
    const std::optional<VelodyneModel> named = VelodyneModelOf(kind.product_id);
    const std::optional<VelodyneModel> model = named ? named : options_.velodyne_model;
    if (!kind.one_bank || !model) {
      study.kind = kind;
      return;
    }
    ++study.votes[static_cast<std::size_t>(*model)];
    if (study.counter == nullptr) {
      VelodyneStreamOptions counting;
      counting.model = study.counted_as = *model;
      counting.cut_deg = options_.velodyne_cut_deg;
      counting.decode = false;
      study.counter = std::make_unique<VelodyneStream>(counting, HourClock(options_.start_ns));
    }
    study.counter->Add(packet, nullptr);
  }

  bool AddOuster(const Datagram& packet) {
    const std::optional<std::size_t> metadata = MetadataOf(packet);
    if (!metadata) return false;
    Study& study = Find(Kind::kOuster, packet.port, packet.source);
    const OusterLayout& layout = set_.layouts[*metadata];
    if (study.counter == nullptr) {
      OusterStreamOptions counting;
      counting.decode = false;
      study.stream.metadata = *metadata;
      study.stream.serial = layout.Serial(packet.data);
      study.counter = std::make_unique<OusterStream>(set_.metadata[*metadata], layout, counting);
    }
    if (study.stream.metadata != *metadata) return false;
    ++study.stream.datagrams;
    study.counter->Add(packet, nullptr);
    const std::uint8_t* last = layout.Column(packet.data, layout.columns - 1);
    if (packet.captured_ns && study.capture_offsets_ns.size() < kClockSamples &&
        layout.IsValid(last)) {
      const std::uint64_t limit = std::uint64_t{1} << 62U;
      study.capture_offsets_ns.push_back(
          *packet.captured_ns -
          static_cast<std::int64_t>(std::min<std::uint64_t>(layout.TimeNs(last), limit)));
    }
    return true;
  }

  /// Of those whose packets have this size: the one with the packet's serial number, else the one
  /// with its port, else the first.
  std::optional<std::size_t> MetadataOf(const Datagram& packet) const {
    std::optional<std::size_t> best;
    int best_score = -1;
    for (std::size_t i = 0; i < set_.layouts.size(); ++i) {
      const OusterLayout& layout = set_.layouts[i];
      if (!layout.IsLidarPacket(packet.data, packet.size)) continue;
      const std::uint64_t serial = layout.Serial(packet.data);
      const int score = (serial != 0 && serial == set_.metadata[i].serial ? 2 : 0) +
                        (packet.port == set_.metadata[i].lidar_port ? 1 : 0);
      if (score > best_score) {
        best = i;
        best_score = score;
      }
    }
    return best;
  }

  void FinishVelodyne(Study* study) {
    PacketStream& stream = study->stream;
    const auto most = std::max_element(study->votes.begin(), study->votes.end());
    if (2 * *most <= stream.datagrams) {
      stream.problem = WhyUnsupported(study->kind);
      return;
    }
    stream.model = static_cast<VelodyneModel>(most - study->votes.begin());
    if (*stream.model == study->counted_as) stream.sweeps = study->counter->counts().sweeps;
    const auto gps = gps_ahead_ns_.find(stream.source);
    if (gps != gps_ahead_ns_.end()) stream.gps_ahead_ns = gps->second;
  }

  void FinishOuster(Study* study) {
    PacketStream& stream = study->stream;
    const OusterMetadata& metadata = set_.metadata[stream.metadata];
    if (stream.serial != 0 && metadata.serial != 0 && stream.serial != metadata.serial) {
      stream.problem = "packets of the Ouster sensor " + std::to_string(stream.serial) + ", but " +
                       metadata.path.string() + " is of the sensor " +
                       std::to_string(metadata.serial) +
                       ": points would be in wrong places; give the metadata file of this sensor";
      return;
    }
    stream.sweeps = study->counter->counts().sweeps;
    if (study->capture_offsets_ns.empty()) return;
    stream.capture_offset_ns = UpperMedian(study->capture_offsets_ns);
  }

  std::string MissingMetadata() const {
    const std::filesystem::path own = std::filesystem::path(path_).replace_extension(".json");
    std::string text = "packets as of an Ouster sensor, but ";
    if (!set_.metadata.empty()) {
      text += "not of the size that " + set_.metadata.front().path.string() + " tells (" +
              std::to_string(set_.layouts.front().packet_size) + " bytes)";
    } else if (!set_.failures.empty()) {
      text += "no usable metadata: " + set_.failures;
    } else {
      text +=
          "no metadata: " + own.string() + " was looked for, or a single .json beside the capture";
    }
    return text + "; give the sensor's metadata file";
  }

  const std::filesystem::path& path_;
  const PacketOptions& options_;
  MetadataSet set_;
  std::map<std::tuple<Kind, std::uint16_t, IpAddress>, std::size_t> by_key_;
  std::vector<Study> studies_;
  std::map<IpAddress, std::int64_t> gps_ahead_ns_;
};

}  // namespace

CaptureSurvey SurveyCapture(const std::filesystem::path& path, const PacketOptions& options,
                            CaptureFile* capture) {
  Surveyor surveyor(path, options);
  for (Datagram packet; capture->Next(&packet);) surveyor.Add(packet);
  return surveyor.Finish();
}

}  // namespace trajlo
