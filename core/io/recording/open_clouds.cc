// SPDX-License-Identifier: MIT
#include "core/io/recording/open_clouds.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "core/io/errors.h"
#include "core/io/messages/ros_cloud_reader.h"
#include "core/io/packets/packet_cloud_reader.h"
#include "core/io/random_access_file.h"
#include "core/io/recording/chained_clouds.h"
#include "core/io/ros1/ros1_bag_reader.h"
#include "core/io/ros2/rosbag2_metadata.h"
#include "core/io/ros2/rosbag2_reader.h"
#include "core/io/scan_listing.h"
#include "core/io/velodyne_payloads.h"

namespace trajlo {
namespace {

namespace fs = std::filesystem;

bool IsNamedAsRos1(const fs::path& path) {
  return path.extension() == ".bag" || path.extension() == ".active";
}

/// The bags of a folder, in the natural order of their names; empty if none is of ROS 1.
std::vector<fs::path> BagsWithRos1(const fs::path& folder) {
  std::vector<fs::path> bags;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (IsNamedAsRos1(entry) || IsRosbag2File(entry)) bags.push_back(entry);
  }
  if (std::none_of(bags.begin(), bags.end(), IsNamedAsRos1)) return {};
  SortNaturally(&bags);
  return bags;
}

/// Enough for a packet of a Velodyne; all other kinds show themselves in a few bytes. Throws
/// InputError where the file cannot be opened.
std::string FirstBytes(const fs::path& path) {
  return std::string(RandomAccessFile(path).Read(0, 1206).view());
}

bool BeginsWith(const std::string& bytes, std::string_view magic) {
  return bytes.compare(0, magic.size(), magic) == 0;
}

bool IsCapture(const std::string& bytes) {
  using namespace std::literals;
  const auto magics = {"\xd4\xc3\xb2\xa1"sv, "\xa1\xb2\xc3\xd4"sv, "\x4d\x3c\xb2\xa1"sv,
                       "\xa1\xb2\x3c\x4d"sv, "\x0a\x0d\x0d\x0a"sv};
  return std::any_of(magics.begin(), magics.end(),
                     [&](std::string_view magic) { return BeginsWith(bytes, magic); });
}

bool BeginsAsPackets(const std::string& bytes) {
  return IsCapture(bytes) || BeginsAsVelodynePayloads(bytes);
}

bool BeginsAsRos2(const std::string& bytes) {
  return BeginsWith(bytes, "\x89MCAP") || BeginsWith(bytes, "SQLite format 3");
}

std::unique_ptr<CloudMessageReader> OpenRos1(const fs::path& path, const CloudOptions& options) {
  return std::make_unique<RosCloudReader>(std::make_unique<Ros1BagReader>(path, options.threads),
                                          path);
}

std::unique_ptr<CloudMessageReader> OpenRos2(const fs::path& path) {
  return std::make_unique<RosCloudReader>(std::make_unique<Rosbag2Reader>(path), path);
}

[[noreturn]] void FailUnknown(const fs::path& path) {
  constexpr char kFolder[] = "For scans as .pcd, .ply or .bin, give the folder that holds them.";
  if (path.extension() != ".bin") {
    throw InputError(path, "this file is neither a bag (.bag, .db3, .mcap) nor a capture (.pcap)",
                     kFolder);
  }
  std::error_code error;
  const bool may_be_scan = fs::file_size(path, error) % 16 == 0;
  throw InputError(path,
                   std::string("this .bin file does not begin with a data packet of a Velodyne") +
                       (may_be_scan ? "; it may be a single scan" : ""),
                   kFolder);
}

std::unique_ptr<CloudMessageReader> OpenFile(const fs::path& path, const CloudOptions& options) {
  const std::string bytes = FirstBytes(path);
  if (bytes.empty()) {
    throw InputError(path, "the file is empty", "Was it copied, or recorded, to its end?");
  }
  if (BeginsWith(bytes, "#ROSBAG V")) return OpenRos1(path, options);
  if (BeginsAsPackets(bytes)) {
    return std::make_unique<PacketCloudReader>(path, options.packets);
  }
  if (BeginsAsRos2(bytes) || IsRos2Bag(path)) return OpenRos2(path);
  FailUnknown(path);
}

}  // namespace

bool HoldsClouds(const fs::path& path) {
  std::error_code error;
  if (fs::is_regular_file(path, error)) return true;
  return fs::is_directory(path, error) && (IsRos2Bag(path) || !BagsWithRos1(path).empty());
}

bool HoldsPackets(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error) && BeginsAsPackets(FirstBytes(path));
}

std::unique_ptr<CloudMessageReader> OpenClouds(const fs::path& path, const CloudOptions& options) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return OpenFile(path, options);
  const std::vector<fs::path> bags = BagsWithRos1(path);
  if (bags.empty()) return OpenRos2(path);
  std::vector<std::unique_ptr<CloudMessageReader>> parts;
  for (const fs::path& bag : bags) {
    parts.push_back(IsNamedAsRos1(bag) ? OpenRos1(bag, options) : OpenRos2(bag));
  }
  if (parts.size() == 1) return std::move(parts.front());
  return std::make_unique<ChainedClouds>(std::move(parts));
}

std::vector<fs::path> Ros1BagsOf(const fs::path& path) {
  std::error_code error;
  std::vector<fs::path> bags;
  if (fs::is_directory(path, error)) {
    bags = BagsWithRos1(path);
    if (!std::all_of(bags.begin(), bags.end(), IsNamedAsRos1)) bags.clear();
  } else if (BeginsWith(FirstBytes(path), "#ROSBAG V")) {
    bags.push_back(path);
  }
  return bags;
}

std::vector<fs::path> BagsOf(const fs::path& path) {
  std::vector<fs::path> bags = BagsWithRos1(path);
  return bags.empty() ? std::vector<fs::path>{path} : bags;
}

bool HoldsMessages(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) return false;
  if (!Ros1BagsOf(path).empty() || IsRos2Bag(path)) return true;
  if (fs::is_directory(path, error)) return false;
  return BeginsAsRos2(FirstBytes(path));
}

std::unique_ptr<RawMessageReader> OpenMessages(const fs::path& path, int threads) {
  std::error_code error;
  const bool is_folder = fs::is_directory(path, error);
  if (!is_folder && !Ros1BagsOf(path).empty()) {
    return std::make_unique<Ros1BagReader>(path, threads);
  }
  return std::make_unique<Rosbag2Reader>(path);
}

}  // namespace trajlo
