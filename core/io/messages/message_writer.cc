// SPDX-License-Identifier: MIT
#include "core/io/messages/message_writer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "core/io/errors.h"
#include "core/io/stamp_text.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

/// The constants of sensor_msgs/PointField.
enum PointFieldType : std::uint8_t { kFieldUint16 = 4, kFieldUint32 = 6, kFieldFloat32 = 7 };

struct PointField {
  std::string name;
  std::uint32_t offset;
  PointFieldType type;
};

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
void PutPoints(std::size_t step, const LidarScan& scan, Putter&& put, WireWriter* out) {
  char* at = out->Extend(step * scan.points.size());
  for (const LidarPoint& point : scan.points) {
    put(at, point);
    at += step;
  }
}

/// All of a PointCloud2 up to the points, which follow.
void PutCloudHead(const MessageHeader& header, const std::vector<PointField>& fields,
                  std::size_t point_step, std::size_t count, WireWriter* out) {
  const auto n = static_cast<std::uint32_t>(count);
  const auto step = static_cast<std::uint32_t>(point_step);
  PutHeader(header, out);
  out->Put(std::uint32_t{1});  // height
  out->Put(n);
  out->Put(static_cast<std::uint32_t>(fields.size()));
  for (const PointField& field : fields) {
    out->PutString(field.name).Put(field.offset).Put(static_cast<std::uint8_t>(field.type));
    out->Put(std::uint32_t{1});
  }
  out->Put(std::uint8_t{0});  // is_bigendian
  out->Put(step);
  out->Put(step * n);  // row_step
  out->Put(step * n);  // size of the data
}

template <typename Putter>
std::string WritePointCloud2(const MessageHeader& header, const std::vector<PointField>& fields,
                             std::size_t point_step, const LidarScan& scan, Encoding encoding,
                             Putter&& put) {
  WireWriter out(encoding);
  PutCloudHead(header, fields, point_step, scan.points.size(), &out);
  PutPoints(point_step, scan, put, &out);
  out.Put(std::uint8_t{0});  // is_dense: there may be NaN
  return out.Take();
}

std::string WriteOuster(const MessageHeader& header, std::int64_t sweep_start_ns,
                        const LidarScan& scan, Encoding encoding) {
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
                          48, scan, encoding, [&](char* out, const LidarPoint& point) {
                            PutXyz(out, 0, point);
                            Put(out, 16, point.intensity);
                            Put(out, 20, OffsetNs(point, sweep_start_ns));
                            Put(out, 24, Rounded<std::uint16_t>(point.intensity));
                            Put(out, 32,
                                Rounded<std::uint32_t>(1000.0 * point.xyz_m.cast<double>().norm()));
                          });
}

std::string WriteVelodyne(const MessageHeader& header, std::int64_t sweep_start_ns,
                          const LidarScan& scan, Encoding encoding) {
  return WritePointCloud2(header,
                          {{"x", 0, kFieldFloat32},
                           {"y", 4, kFieldFloat32},
                           {"z", 8, kFieldFloat32},
                           {"intensity", 12, kFieldFloat32},
                           {"ring", 16, kFieldUint16},
                           {"time", 18, kFieldFloat32}},
                          22, scan, encoding, [&](char* out, const LidarPoint& point) {
                            PutXyz(out, 0, point);
                            Put(out, 12, point.intensity);
                            Put(out, 18, static_cast<float>(Seconds(point.t_ns - sweep_start_ns)));
                          });
}

std::string WriteLivox(const MessageHeader& header, std::int64_t sweep_start_ns,
                       const LidarScan& scan, Encoding encoding) {
  constexpr char kNormalPoint = 0x10;  // The tag of a single return that is no noise.
  const auto n = static_cast<std::uint32_t>(scan.points.size());
  WireWriter out(encoding);
  PutHeader(header, &out);
  out.Put(static_cast<std::uint64_t>(sweep_start_ns));  // timebase
  out.Put(n);
  out.Extend(4);  // lidar_id and three reserved bytes
  out.Put(n);
  // In CDR a point that is not the last one is filled up to a multiple of four.
  const bool is_cdr = encoding == Encoding::kCdr;
  const std::size_t step = is_cdr ? 20 : 19;
  const std::size_t beyond = is_cdr && n > 0 ? 1 : 0;
  PutPoints(
      step, scan,
      [&](char* at, const LidarPoint& point) {
        Put(at, 0, OffsetNs(point, sweep_start_ns));
        PutXyz(at, 4, point);
        Put(at, 16, Rounded<std::uint8_t>(point.intensity));
        Put(at, 17, kNormalPoint);
      },
      &out);
  std::string bytes = out.Take();
  bytes.resize(bytes.size() - beyond);
  return bytes;
}

/// ROS 1 has unsigned seconds, ROS 2 signed ones.
void CheckSeconds(std::int64_t seconds, const MessageHeader& header, bool is_ros2) {
  using Ros1 = std::numeric_limits<std::uint32_t>;
  using Ros2 = std::numeric_limits<std::int32_t>;
  const auto least = is_ros2 ? std::int64_t{Ros2::min()} : std::int64_t{Ros1::min()};
  const auto greatest = is_ros2 ? std::int64_t{Ros2::max()} : std::int64_t{Ros1::max()};
  if (seconds >= least && seconds <= greatest) return;
  throw OutputError("a message of frame '" + header.frame_id + "'",
                    "the stamp " + FormatSeconds(header.stamp_ns) + " s does not fit: ROS " +
                        (is_ros2 ? "2" : "1") + " holds " + std::to_string(least) + " to " +
                        std::to_string(greatest) + " s");
}

}  // namespace

void PutHeader(const MessageHeader& header, WireWriter* out) {
  // Nanoseconds are unsigned: -0.3 s is -1 s and 700,000,000 ns.
  const std::int64_t beyond_ns = header.stamp_ns % kNsPerSecond;
  const bool is_below = beyond_ns < 0;
  const std::int64_t seconds = header.stamp_ns / kNsPerSecond - (is_below ? 1 : 0);
  CheckSeconds(seconds, header, out->is_cdr());
  if (!out->is_cdr()) out->Put(header.seq);
  out->Put(static_cast<std::uint32_t>(seconds));
  out->Put(static_cast<std::uint32_t>(beyond_ns + (is_below ? kNsPerSecond : 0)));
  out->PutString(header.frame_id);
}

void PutPose(const SE3& pose, WireWriter* out) {
  for (int i = 0; i < 3; ++i) out->Put(pose.t[i]);
  for (int i = 0; i < 4; ++i) out->Put(pose.q.coeffs()[i]);  // x, y, z, w
}

const MessageDescription& DescriptionOf(CloudLayout layout) {
  return layout == CloudLayout::kLivox ? LivoxCustomMsgDescription() : PointCloud2Description();
}

std::string WriteCloud(CloudLayout layout, const MessageHeader& header, std::int64_t sweep_start_ns,
                       const LidarScan& scan, Encoding encoding) {
  switch (layout) {
    case CloudLayout::kOuster:
      return WriteOuster(header, sweep_start_ns, scan, encoding);
    case CloudLayout::kVelodyne:
      return WriteVelodyne(header, sweep_start_ns, scan, encoding);
    case CloudLayout::kLivox:
      return WriteLivox(header, sweep_start_ns, scan, encoding);
  }
  throw std::invalid_argument("unknown layout of point clouds");
}

std::string WriteFloatCloud(const MessageHeader& header, const std::vector<std::string>& fields,
                            const std::vector<float>& values, Encoding encoding) {
  std::vector<PointField> float_fields;
  for (const std::string& name : fields) {
    const auto offset = static_cast<std::uint32_t>(sizeof(float) * float_fields.size());
    float_fields.push_back({name, offset, kFieldFloat32});
  }
  WireWriter out(encoding);
  PutCloudHead(header, float_fields, sizeof(float) * fields.size(), values.size() / fields.size(),
               &out);
  out.PutBytes({reinterpret_cast<const char*>(values.data()), sizeof(float) * values.size()});
  out.Put(std::uint8_t{1});  // is_dense
  return out.Take();
}

std::string WritePoseStamped(const MessageHeader& header, const SE3& T_world_body,
                             Encoding encoding) {
  WireWriter out(encoding);
  PutHeader(header, &out);
  PutPose(T_world_body, &out);
  return out.Take();
}

}  // namespace trajlo
