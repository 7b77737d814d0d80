// SPDX-License-Identifier: MIT
#include "core/io/packets/ouster_metadata.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/io/errors.h"

namespace trajlo {
namespace {

using nlohmann::json;

constexpr std::size_t kMostRows = 256;
constexpr std::size_t kMostColumns = 8192;

/// Looks entries up where the flat and the nested layouts keep them.
class Entries {
 public:
  Entries(const std::filesystem::path& path, const json& root) : path_(path), root_(root) {}

  /// Null if there is none. Each place is "section/key" or "key".
  const json* Find(std::initializer_list<const char*> places) const {
    for (const char* place : places) {
      const json::json_pointer pointer(std::string("/") + place);
      if (root_.contains(pointer) && !root_.at(pointer).is_null()) return &root_.at(pointer);
    }
    return nullptr;
  }

  const json& Get(std::initializer_list<const char*> places) const {
    const json* entry = Find(places);
    if (entry == nullptr) {
      Fail("the entry " + Name(places) + " is missing",
           "Give the metadata that the sensor itself serves; a capture cannot be read without it.");
    }
    return *entry;
  }

  std::string Text(std::initializer_list<const char*> places) const {
    const json* entry = Find(places);
    if (entry == nullptr) return {};
    return entry->is_string() ? entry->get<std::string>() : entry->dump();
  }

  std::uint64_t Number(std::initializer_list<const char*> places, std::uint64_t least,
                       std::uint64_t most) const {
    const json& entry = Get(places);
    if (!entry.is_number_unsigned() || entry.get<std::uint64_t>() < least ||
        entry.get<std::uint64_t>() > most) {
      Fail("the entry " + Name(places) + " is " + entry.dump() + " instead of a number from " +
               std::to_string(least) + " to " + std::to_string(most),
           "");
    }
    return entry.get<std::uint64_t>();
  }

  std::vector<double> Numbers(const json& entry, std::initializer_list<const char*> places) const {
    std::vector<double> numbers;
    for (const json& value : entry) {
      if (!value.is_number() || !std::isfinite(value.get<double>())) {
        Fail("the entry " + Name(places) + " holds something else than numbers",
             "Sensors whose beams differ from column to column are not supported.");
      }
      numbers.push_back(value.get<double>());
    }
    return numbers;
  }

  Eigen::Matrix4d Transform(const json& entry, std::initializer_list<const char*> places) const {
    const std::vector<double> numbers = Numbers(entry, places);
    if (numbers.size() != 16) {
      Fail("the entry " + Name(places) + " has " + std::to_string(numbers.size()) +
               " numbers instead of 16",
           "");
    }
    return Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(numbers.data());
  }

  [[noreturn]] void Fail(const std::string& found, const std::string& mend) const {
    throw InputError(path_, found, mend);
  }

 private:
  static std::string Name(std::initializer_list<const char*> places) {
    const std::string_view first = *places.begin();
    return std::string(first.substr(first.find('/') + 1));
  }

  const std::filesystem::path& path_;
  const json& root_;
};

/// "1024x10": columns and frames a second.
std::size_t ColumnsOfMode(const Entries& entries, const std::string& mode) {
  const std::size_t columns = std::strtoul(mode.c_str(), nullptr, 10);
  if (columns == 0 || columns > kMostColumns || mode.find('x') == std::string::npos) {
    entries.Fail("the lidar_mode is \"" + mode + "\"", "Expected a mode such as 1024x10.");
  }
  return columns;
}

void ReadFormat(const Entries& entries, OusterMetadata* metadata) {
  metadata->mode = entries.Text({"lidar_mode", "config_params/lidar_mode"});
  metadata->columns_per_packet = 16;
  metadata->profile = "LEGACY";
  if (entries.Find({"data_format", "lidar_data_format"}) == nullptr) {
    // Firmware before 2.0 had one format only.
    metadata->columns_per_frame = ColumnsOfMode(entries, metadata->mode);
    metadata->last_column = metadata->columns_per_frame - 1;
    return;
  }
  metadata->columns_per_frame = entries.Number(
      {"data_format/columns_per_frame", "lidar_data_format/columns_per_frame"}, 1, kMostColumns);
  metadata->columns_per_packet = entries.Number(
      {"data_format/columns_per_packet", "lidar_data_format/columns_per_packet"}, 1, 128);
  const std::uint64_t rows = entries.Number(
      {"data_format/pixels_per_column", "lidar_data_format/pixels_per_column"}, 1, kMostRows);
  if (rows != metadata->rows()) {
    entries.Fail("there are " + std::to_string(metadata->rows()) + " beams, but " +
                     std::to_string(rows) + " pixels_per_column",
                 "");
  }
  const std::string profile =
      entries.Text({"data_format/udp_profile_lidar", "lidar_data_format/udp_profile_lidar",
                    "config_params/udp_profile_lidar"});
  if (!profile.empty()) metadata->profile = profile;
  metadata->fusa_header =
      metadata->profile.compare(0, 5, "FUSA_") == 0 ||
      entries.Text({"data_format/header_type", "lidar_data_format/header_type"}) == "FUSA";
  metadata->last_column = metadata->columns_per_frame - 1;
  if (entries.Find({"data_format/column_window", "lidar_data_format/column_window"}) != nullptr) {
    const std::size_t most = metadata->columns_per_frame - 1;
    metadata->first_column = entries.Number(
        {"data_format/column_window/0", "lidar_data_format/column_window/0"}, 0, most);
    metadata->last_column = entries.Number(
        {"data_format/column_window/1", "lidar_data_format/column_window/1"}, 0, most);
  }
}

void ReadBeams(const Entries& entries, OusterMetadata* metadata) {
  metadata->altitude_deg =
      entries.Numbers(entries.Get({"beam_altitude_angles", "beam_intrinsics/beam_altitude_angles"}),
                      {"beam_altitude_angles"});
  metadata->azimuth_deg =
      entries.Numbers(entries.Get({"beam_azimuth_angles", "beam_intrinsics/beam_azimuth_angles"}),
                      {"beam_azimuth_angles"});
  const std::size_t rows = metadata->rows();
  if (rows == 0 || rows > kMostRows || metadata->azimuth_deg.size() != rows) {
    entries.Fail("there are " + std::to_string(rows) + " beam_altitude_angles and " +
                     std::to_string(metadata->azimuth_deg.size()) + " beam_azimuth_angles",
                 "");
  }
  if (const json* transform =
          entries.Find({"beam_to_lidar_transform", "beam_intrinsics/beam_to_lidar_transform"})) {
    metadata->T_lidar_beam_mm = entries.Transform(*transform, {"beam_to_lidar_transform"});
  } else {
    const json& offset = entries.Get(
        {"lidar_origin_to_beam_origin_mm", "beam_intrinsics/lidar_origin_to_beam_origin_mm"});
    if (!offset.is_number()) {
      entries.Fail("the entry lidar_origin_to_beam_origin_mm is " + offset.dump(), "");
    }
    metadata->T_lidar_beam_mm(0, 3) = offset.get<double>();
  }
  metadata->T_sensor_lidar_mm = entries.Transform(
      entries.Get({"lidar_to_sensor_transform", "lidar_intrinsics/lidar_to_sensor_transform"}),
      {"lidar_to_sensor_transform"});
}

bool StartsWith(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

}  // namespace

std::size_t OusterMetadata::window() const {
  return (last_column + columns_per_frame - first_column) % columns_per_frame + 1;
}

OusterMetadata ReadOusterMetadata(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw InputError(path, "opening failed", "Check that you may read the metadata.");
  const json root = json::parse(file, nullptr, false);
  if (!root.is_object()) throw InputError(path, "this is not a JSON object", "");
  const Entries entries(path, root);
  OusterMetadata metadata;
  metadata.path = path;
  ReadBeams(entries, &metadata);
  ReadFormat(entries, &metadata);
  metadata.product = entries.Text({"prod_line", "sensor_info/prod_line"});
  const std::string serial = entries.Text({"prod_sn", "sensor_info/prod_sn"});
  metadata.serial = std::strtoull(serial.c_str(), nullptr, 10);
  const std::string port = entries.Text({"udp_port_lidar", "config_params/udp_port_lidar"});
  metadata.lidar_port = static_cast<std::uint16_t>(std::strtoul(port.c_str(), nullptr, 10));
  return metadata;
}

std::vector<std::filesystem::path> FindOusterMetadata(const std::filesystem::path& capture) {
  const std::filesystem::path folder =
      capture.has_parent_path() ? capture.parent_path() : std::filesystem::path(".");
  const std::string stem = capture.stem().string();
  std::vector<std::filesystem::path> all;
  std::vector<std::filesystem::path> own;
  std::filesystem::path longest;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (entry.path().extension() != ".json") continue;
    all.push_back(entry.path());
    const std::string name = entry.path().stem().string();
    if (StartsWith(name, stem)) own.push_back(entry.path());
    const bool longer = longest.empty() || name.size() > longest.stem().string().size();
    if (StartsWith(stem, name) && longer) longest = entry.path();
  }
  std::sort(own.begin(), own.end());
  if (!own.empty()) return own;
  if (!longest.empty()) return {longest};
  return all.size() == 1 ? all : std::vector<std::filesystem::path>{};
}

}  // namespace trajlo
