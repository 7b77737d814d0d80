// SPDX-License-Identifier: MIT
#include "core/io/messages/message_writer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace trajlo {
namespace {

/// The constants of sensor_msgs/PointField.
enum PointFieldType : std::uint8_t { kFieldUint16 = 4, kFieldUint32 = 6, kFieldFloat32 = 7 };

struct PointField {
  const char* name;
  std::uint32_t offset;
  PointFieldType type;
};

template <typename T>
void Append(std::string* out, T value) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  out->append(bytes, sizeof(T));
}

void AppendString(std::string* out, std::string_view text) {
  Append(out, static_cast<std::uint32_t>(text.size()));
  out->append(text);
}

void AppendHeader(std::string* out, const MessageHeader& header) {
  Append(out, header.seq);
  Append(out, static_cast<std::uint32_t>(header.stamp_ns / 1'000'000'000));
  Append(out, static_cast<std::uint32_t>(header.stamp_ns % 1'000'000'000));
  AppendString(out, header.frame_id);
}

template <typename T>
void Put(char* point, std::size_t offset, T value) {
  std::memcpy(point + offset, &value, sizeof(T));
}

void PutXyz(char* point, std::size_t offset, const LidarPoint& from) {
  std::memcpy(point + offset, from.xyz_m.data(), 3 * sizeof(float));
}

/// A number that is not finite becomes 0.
template <typename T>
T Rounded(double value) {
  if (!std::isfinite(value)) return 0;
  return static_cast<T>(
      std::clamp(std::round(value), 0.0, static_cast<double>(std::numeric_limits<T>::max())));
}

std::uint32_t OffsetNs(const LidarPoint& point, std::int64_t sweep_start_ns) {
  const std::int64_t offset_ns = point.t_ns - sweep_start_ns;
  if (offset_ns < 0 || offset_ns > std::numeric_limits<std::uint32_t>::max()) {
    throw std::invalid_argument("a point " + std::to_string(offset_ns) +
                                " ns after the start of its sweep does not fit into a message");
  }
  return static_cast<std::uint32_t>(offset_ns);
}

/// `put(bytes, point)` writes one point over zeros.
template <typename Putter>
void AppendPoints(std::string* out, std::size_t step, const LidarScan& scan, Putter&& put) {
  const std::size_t begin = out->size();
  out->resize(begin + step * scan.points.size());
  char* at = out->data() + begin;
  for (const LidarPoint& point : scan.points) {
    put(at, point);
    at += step;
  }
}

template <typename Putter>
std::string WritePointCloud2(const MessageHeader& header, const std::vector<PointField>& fields,
                             std::uint32_t point_step, const LidarScan& scan, Putter&& put) {
  const auto n = static_cast<std::uint32_t>(scan.points.size());
  std::string out;
  AppendHeader(&out, header);
  Append(&out, std::uint32_t{1});  // height
  Append(&out, n);
  Append(&out, static_cast<std::uint32_t>(fields.size()));
  for (const PointField& field : fields) {
    AppendString(&out, field.name);
    Append(&out, field.offset);
    Append(&out, static_cast<std::uint8_t>(field.type));
    Append(&out, std::uint32_t{1});
  }
  Append(&out, std::uint8_t{0});  // is_bigendian
  Append(&out, point_step);
  Append(&out, point_step * n);  // row_step
  Append(&out, point_step * n);  // size of the data
  AppendPoints(&out, point_step, scan, put);
  Append(&out, std::uint8_t{0});  // is_dense: there may be NaN
  return out;
}

std::string WriteOuster(const MessageHeader& header, std::int64_t sweep_start_ns,
                        const LidarScan& scan) {
  return WritePointCloud2(header,
                          {{"x", 0, kFieldFloat32},
                           {"y", 4, kFieldFloat32},
                           {"z", 8, kFieldFloat32},
                           {"intensity", 16, kFieldFloat32},
                           {"t", 20, kFieldUint32},
                           {"reflectivity", 24, kFieldUint16},
                           {"ring", 26, kFieldUint16},
                           {"ambient", 28, kFieldUint16},
                           {"range", 32, kFieldUint32}},
                          48, scan, [&](char* out, const LidarPoint& point) {
                            PutXyz(out, 0, point);
                            Put(out, 16, point.intensity);
                            Put(out, 20, OffsetNs(point, sweep_start_ns));
                            Put(out, 24, Rounded<std::uint16_t>(point.intensity));
                            Put(out, 32,
                                Rounded<std::uint32_t>(1000.0 * point.xyz_m.cast<double>().norm()));
                          });
}

std::string WriteVelodyne(const MessageHeader& header, std::int64_t sweep_start_ns,
                          const LidarScan& scan) {
  return WritePointCloud2(
      header,
      {{"x", 0, kFieldFloat32},
       {"y", 4, kFieldFloat32},
       {"z", 8, kFieldFloat32},
       {"intensity", 12, kFieldFloat32},
       {"ring", 16, kFieldUint16},
       {"time", 18, kFieldFloat32}},
      22, scan, [&](char* out, const LidarPoint& point) {
        PutXyz(out, 0, point);
        Put(out, 12, point.intensity);
        Put(out, 18, static_cast<float>(1e-9 * static_cast<double>(point.t_ns - sweep_start_ns)));
      });
}

std::string WriteLivox(const MessageHeader& header, std::int64_t sweep_start_ns,
                       const LidarScan& scan) {
  constexpr char kNormalPoint = 0x10;  // The tag of a single return that is no noise.
  const auto n = static_cast<std::uint32_t>(scan.points.size());
  std::string out;
  AppendHeader(&out, header);
  Append(&out, static_cast<std::uint64_t>(sweep_start_ns));  // timebase
  Append(&out, n);
  out.append(4, '\0');  // lidar_id and three reserved bytes
  Append(&out, n);
  AppendPoints(&out, 19, scan, [&](char* at, const LidarPoint& point) {
    Put(at, 0, OffsetNs(point, sweep_start_ns));
    PutXyz(at, 4, point);
    Put(at, 16, Rounded<std::uint8_t>(point.intensity));
    Put(at, 17, kNormalPoint);
  });
  return out;
}

}  // namespace

std::string WriteCloud(CloudLayout layout, const MessageHeader& header, std::int64_t sweep_start_ns,
                       const LidarScan& scan) {
  switch (layout) {
    case CloudLayout::kOuster:
      return WriteOuster(header, sweep_start_ns, scan);
    case CloudLayout::kVelodyne:
      return WriteVelodyne(header, sweep_start_ns, scan);
    case CloudLayout::kLivox:
      return WriteLivox(header, sweep_start_ns, scan);
  }
  throw std::invalid_argument("unknown layout of point clouds");
}

std::string WritePoseStamped(const MessageHeader& header, const SE3& T_world_body) {
  std::string out;
  AppendHeader(&out, header);
  for (int i = 0; i < 3; ++i) Append(&out, T_world_body.t[i]);
  for (int i = 0; i < 4; ++i) Append(&out, T_world_body.q.coeffs()[i]);  // x, y, z, w
  return out;
}

}  // namespace trajlo
