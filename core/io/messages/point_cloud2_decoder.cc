// SPDX-License-Identifier: MIT
#include "core/io/messages/point_cloud2_decoder.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "core/io/messages/message_header.h"
#include "core/io/messages/wire_reader.h"

namespace trajlo {
namespace {

struct PointField {
  std::string name;
  std::uint32_t offset = 0;
  std::uint8_t datatype = 0;
};

/// How the points lie in the data, as the message declares it.
struct Layout {
  std::uint64_t height = 0, width = 0, point_step = 0, row_step = 0;
  bool is_big_endian = false;
  std::vector<PointField> fields;
  std::size_t data_offset = 0;
  std::uint64_t data_declared = 0, data_there = 0;

  std::uint64_t Points() const { return height * width; }
  std::uint64_t RowBytes() const { return width * point_step; }
  /// A row_step that contradicts the amount of data is a slip of the driver, not padding.
  bool HasPaddedRows() const {
    if (height < 2 || row_step <= RowBytes()) return false;
    return point_step == 0 || data_declared % point_step != 0 ||
           data_declared / point_step != Points();
  }
};

/// How many points the data hold behind those declared. Rows are padded to whole words or lines of
/// a cache, not by many whole points.
std::uint64_t UndeclaredPoints(const Layout& layout) {
  constexpr std::uint64_t kMostPadding = 128;
  if (layout.point_step == 0) return 0;
  const bool padded = layout.HasPaddedRows();
  const std::uint64_t rest_of_row = padded ? layout.row_step - layout.RowBytes() : 0;
  const bool is_padding = rest_of_row < std::max(kMostPadding, layout.point_step) ||
                          rest_of_row % layout.point_step != 0;
  const std::uint64_t bytes =
      is_padding && padded ? layout.height * layout.row_step : layout.Points() * layout.point_step;
  if (layout.data_there < bytes + layout.point_step) return 0;
  return layout.data_there / layout.point_step - layout.Points();
}

std::string TellOfMoreData(const Layout& layout) {
  return std::to_string(layout.height) + " x " + std::to_string(layout.width) + " points of " +
         std::to_string(layout.point_step) + " bytes are declared, and the " +
         std::to_string(layout.data_there) + " bytes of data hold " +
         std::to_string(layout.data_there / layout.point_step) +
         ": only those declared are read, so check height and width where this was written";
}

/// The constants of sensor_msgs/PointField.
std::optional<ScalarType> TypeOf(std::uint8_t datatype) {
  constexpr ScalarType kTypes[] = {ScalarType::kInt8,    ScalarType::kUint8,  ScalarType::kInt16,
                                   ScalarType::kUint16,  ScalarType::kInt32,  ScalarType::kUint32,
                                   ScalarType::kFloat32, ScalarType::kFloat64};
  if (datatype < 1 || datatype > std::size(kTypes)) return {};
  return kTypes[datatype - 1];
}

Layout ReadLayout(WireReader* reader) {
  Layout layout;
  layout.height = reader->Read<std::uint32_t>();
  layout.width = reader->Read<std::uint32_t>();
  const auto fields = reader->Read<std::uint32_t>();
  for (std::uint32_t i = 0; i < fields && reader->ok(); ++i) {
    PointField field;
    field.name = reader->ReadString();
    field.offset = reader->Read<std::uint32_t>();
    field.datatype = reader->Read<std::uint8_t>();
    reader->Read<std::uint32_t>();  // How many elements: the first one is taken.
    layout.fields.push_back(std::move(field));
  }
  layout.is_big_endian = reader->Read<std::uint8_t>() != 0;
  layout.point_step = reader->Read<std::uint32_t>();
  layout.row_step = reader->Read<std::uint32_t>();
  layout.data_declared = reader->Read<std::uint32_t>();
  layout.data_offset = reader->position();
  layout.data_there = std::min<std::uint64_t>(layout.data_declared, reader->remaining());
  return layout;
}

/// Moves the points of all rows together; returns how many whole ones there are.
std::uint64_t CompactRows(const Layout& layout, char* data) {
  const std::uint64_t row_bytes = layout.RowBytes();
  std::uint64_t points = 0;
  for (std::uint64_t row = 0; row < layout.height; ++row) {
    if (row * layout.row_step >= layout.data_there) break;
    const std::uint64_t there = std::min(row_bytes, layout.data_there - row * layout.row_step);
    std::memmove(data + row * row_bytes, data + row * layout.row_step, there);
    points += there / layout.point_step;
  }
  return points;
}

std::uint64_t CountPoints(const Layout& layout, char* data) {
  if (layout.point_step == 0 || layout.Points() == 0) return 0;
  if (layout.HasPaddedRows()) return CompactRows(layout, data);
  return std::min(layout.Points(), layout.data_there / layout.point_step);
}

void AddColumns(const Layout& layout, PointTable* table, std::string* remark) {
  for (const PointField& field : layout.fields) {
    const auto type = TypeOf(field.datatype);
    const bool fits = type && field.offset + SizeOf(*type) <= layout.point_step;
    if (fits) {
      table->columns.push_back({field.name, *type, layout.data_offset + field.offset,
                                static_cast<std::size_t>(layout.point_step), layout.is_big_endian});
      continue;
    }
    *remark += std::string(remark->empty() ? "" : "; ") + "field '" + field.name + "' is ignored: ";
    *remark += type ? "it begins at byte " + std::to_string(field.offset) + " of points of " +
                          std::to_string(layout.point_step) + " bytes"
                    : "its type " + std::to_string(field.datatype) + " is unknown";
  }
}

}  // namespace

bool DecodePointCloud2(Encoding encoding, FileBytes* bytes, CloudMessage* cloud,
                       std::string* remark) {
  WireReader reader(bytes->view(), encoding);
  MessageHeader header = ReadMessageHeader(&reader);
  const Layout layout = ReadLayout(&reader);
  if (!reader.ok()) {
    *remark = "a PointCloud2 of " + std::to_string(bytes->size()) +
              " bytes that ends before its points begin";
    return false;
  }
  if (layout.Points() > 0 && layout.point_step == 0) {
    *remark = "a PointCloud2 with points of no bytes";
    return false;
  }
  PointTable table;
  table.count = static_cast<std::size_t>(CountPoints(layout, bytes->data() + layout.data_offset));
  if (table.count < layout.Points()) {
    table.damage = std::to_string(layout.height) + " x " + std::to_string(layout.width) +
                   " points of " + std::to_string(layout.point_step) + " bytes declared, " +
                   std::to_string(table.count) + " whole ones in the " +
                   std::to_string(layout.data_there) + " bytes of data";
  }
  table.undeclared = static_cast<std::size_t>(UndeclaredPoints(layout));
  if (table.undeclared > 0) *remark = TellOfMoreData(layout);
  AddColumns(layout, &table, remark);
  table.bytes = std::exchange(*bytes, {});
  cloud->stamp_ns = header.stamp_ns;
  cloud->frame_id = std::move(header.frame_id);
  cloud->table = std::move(table);
  return true;
}

}  // namespace trajlo
