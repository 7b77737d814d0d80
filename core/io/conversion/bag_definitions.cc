// SPDX-License-Identifier: MIT
#include "core/io/conversion/bag_definitions.h"

#include <string_view>

#include "core/io/ros1/bag_chunk.h"
#include "core/io/ros1/bag_index.h"
#include "core/io/ros1/damage_log.h"

namespace trajlo {
namespace {

using Definitions = std::map<std::pair<std::string, std::string>, BagDefinition>;

void Take(const ros1::Fields& fields, std::string_view data, Definitions* definitions) {
  const auto connection = ros1::ParseConnection(fields, data);
  const auto described = ros1::Fields::Parse(data);
  if (!connection || !described) return;
  BagDefinition definition;
  definition.md5sum = described->Find("md5sum").value_or("*");
  definition.definition = described->Find("message_definition").value_or("");
  definitions->try_emplace({connection->topic, connection->type}, std::move(definition));
}

/// Those in the index at the end of the file; none if there is no index.
Definitions ReadFromIndex(const ros1::BagFile& file) {
  Definitions definitions;
  const auto header = ros1::ReadRecord(file, ros1::kMagic.size());
  std::uint64_t at = header ? header->fields().Number<std::uint64_t>("index_pos").value_or(0) : 0;
  while (at > 0 && at < file.size()) {
    const auto record = ros1::ReadRecord(file, at);
    if (!record || record->op != ros1::Op::kConnection) break;
    const auto data = ros1::ReadData(file, *record);
    if (!data) break;
    Take(record->fields(), *data, &definitions);
    at = record->end();
  }
  return definitions;
}

}  // namespace

Definitions ReadBagDefinitions(const std::filesystem::path& bag) {
  const ros1::BagFile file(bag);
  Definitions definitions = ReadFromIndex(file);
  ros1::DamageLog log(bag);
  const ros1::BagIndex index = ros1::BuildIndex(file, &log);
  ros1::ChunkReader reader(file);
  ros1::Chunk chunk;
  for (const ros1::ChunkEntry& entry : index.chunks) {
    if (definitions.size() >= index.topics.size()) break;
    reader.Read(entry.offset, entry.limit, &chunk);
    std::string_view bytes = chunk.bytes.view();
    while (const auto record = ros1::TakeRecord(&bytes)) {
      if (record->op == ros1::Op::kConnection) Take(record->fields, record->data, &definitions);
    }
  }
  return definitions;
}

}  // namespace trajlo
