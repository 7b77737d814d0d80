// SPDX-License-Identifier: MIT
#include "core/io/point_table.h"

#include <cctype>

namespace trajlo {
namespace {

struct TypeFacts {
  std::size_t size;
  bool integer;
  const char* name;
};

constexpr TypeFacts kTypeFacts[] = {
    {1, true, "int8"},     {1, true, "uint8"},    {2, true, "int16"}, {2, true, "uint16"},
    {4, true, "int32"},    {4, true, "uint32"},   {8, true, "int64"}, {8, true, "uint64"},
    {4, false, "float32"}, {8, false, "float64"},
};

const TypeFacts& FactsOf(ScalarType type) { return kTypeFacts[static_cast<int>(type)]; }

}  // namespace

std::size_t SizeOf(ScalarType type) { return FactsOf(type).size; }
bool IsInteger(ScalarType type) { return FactsOf(type).integer; }
const char* NameOf(ScalarType type) { return FactsOf(type).name; }

std::string NormalisedFieldName(std::string_view name) {
  std::string lower;
  for (const char c : name) {
    lower += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  constexpr std::string_view kPrefix = "scalar_";
  return lower.rfind(kPrefix, 0) == 0 ? lower.substr(kPrefix.size()) : lower;
}

const Column* PointTable::Find(std::string_view name) const {
  const std::string wanted = NormalisedFieldName(name);
  for (const Column& column : columns) {
    if (NormalisedFieldName(column.name) == wanted) return &column;
  }
  return nullptr;
}

std::string PointTable::FieldNames() const {
  std::string names;
  for (const Column& column : columns) names += (names.empty() ? "" : " ") + column.name;
  return names;
}

}  // namespace trajlo
