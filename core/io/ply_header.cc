// SPDX-License-Identifier: MIT
#include "core/io/ply_header.h"

#include <optional>

#include "core/io/ascii_table.h"
#include "core/io/errors.h"
#include "core/io/number_text.h"

namespace trajlo {
namespace {

std::optional<ScalarType> TypeOf(std::string_view word) {
  if (word == "char" || word == "int8") return ScalarType::kInt8;
  if (word == "uchar" || word == "uint8") return ScalarType::kUint8;
  if (word == "short" || word == "int16") return ScalarType::kInt16;
  if (word == "ushort" || word == "uint16") return ScalarType::kUint16;
  if (word == "int" || word == "int32") return ScalarType::kInt32;
  if (word == "uint" || word == "uint32") return ScalarType::kUint32;
  if (word == "int64" || word == "long") return ScalarType::kInt64;
  if (word == "uint64" || word == "ulong") return ScalarType::kUint64;
  if (word == "float" || word == "float32") return ScalarType::kFloat32;
  if (word == "double" || word == "float64") return ScalarType::kFloat64;
  return {};
}

class HeaderParser {
 public:
  HeaderParser(const std::filesystem::path& path, std::string_view file)
      : path_(path), file_(file), rest_(file) {}

  PlyHeader Parse() {
    std::string_view line;
    if (!TakeLine(&rest_, &line) || TakeWord(&line) != "ply") Fail("the first line is not 'ply'");
    bool ended = false;
    while (!ended && TakeLine(&rest_, &line)) ended = ParseLine(line);
    if (!ended) Fail("no end_header in " + std::to_string(file_.size()) + " bytes");
    if (!has_format_) Fail("no format line");
    header_.data_offset = file_.size() - rest_.size();
    FindVertex();
    return header_;
  }

 private:
  [[noreturn]] void Fail(const std::string& found) const {
    throw InputError(path_, "PLY header: " + found,
                     "Write the file again as PLY 1.0, or remove it from the folder.");
  }

  /// Returns true at end_header.
  bool ParseLine(std::string_view line) {
    const std::string_view key = TakeWord(&line);
    if (key == "end_header") return true;
    if (key == "format") ParseFormat(TakeWord(&line));
    if (key == "element") ParseElement(line);
    if (key == "property") ParseProperty(line);
    return false;
  }

  void ParseFormat(std::string_view word) {
    has_format_ = true;
    if (word == "ascii") {
      header_.format = PlyFormat::kAscii;
    } else if (word == "binary_little_endian") {
      header_.format = PlyFormat::kLittleEndian;
    } else if (word == "binary_big_endian") {
      header_.format = PlyFormat::kBigEndian;
    } else {
      Fail("unknown format '" + std::string(word) + "'");
    }
  }

  void ParseElement(std::string_view line) {
    PlyElement element;
    element.name = std::string(TakeWord(&line));
    const auto count = ParseWhole(TakeWord(&line));
    if (!count || *count > (1ULL << 40)) {
      Fail("element '" + element.name + "' has no usable count");
    }
    element.count = *count;
    header_.elements.push_back(element);
  }

  void ParseProperty(std::string_view line) {
    if (header_.elements.empty()) Fail("a property stands before every element");
    PlyProperty property;
    std::string_view word = TakeWord(&line);
    std::optional<ScalarType> count_type = ScalarType::kUint8;
    if (word == "list") {
      property.is_list = true;
      count_type = TypeOf(TakeWord(&line));
      word = TakeWord(&line);
    }
    const std::optional<ScalarType> type = TypeOf(word);
    property.name = std::string(TakeWord(&line));
    if (!type || !count_type || !IsInteger(*count_type) || property.name.empty()) {
      Fail("property '" + property.name + "' has an unknown type '" + std::string(word) + "'");
    }
    property.type = *type;
    property.count_type = *count_type;
    header_.elements.back().properties.push_back(property);
  }

  void FindVertex() {
    for (; header_.vertex < header_.elements.size(); ++header_.vertex) {
      const std::string& name = header_.elements[header_.vertex].name;
      if (name == "vertex" || name == "point") return;
    }
    Fail("no element named vertex");
  }

  const std::filesystem::path& path_;
  std::string_view file_;
  std::string_view rest_;
  PlyHeader header_;
  bool has_format_ = false;
};

}  // namespace

bool PlyElement::HasList() const {
  for (const PlyProperty& property : properties) {
    if (property.is_list) return true;
  }
  return false;
}

std::size_t PlyElement::RowBytes() const {
  std::size_t sum = 0;
  for (const PlyProperty& property : properties) sum += SizeOf(property.type);
  return sum;
}

PlyHeader ParsePlyHeader(const std::filesystem::path& path, std::string_view file) {
  return HeaderParser(path, file).Parse();
}

}  // namespace trajlo
