// SPDX-License-Identifier: MIT
#include "core/io/ros2/mcap_reader.h"

#include <cstring>
#include <string>
#include <utility>

#include "core/io/errors.h"
#include "core/io/format_text.h"
#include "core/io/ros2/unpack.h"

namespace trajlo {
namespace {

std::shared_ptr<const RandomAccessFile> OpenMcap(const std::filesystem::path& path,
                                                 const std::filesystem::path& shown) {
  auto file = std::make_shared<const RandomAccessFile>(path);
  if (file->Read(0, kMcapMagic.size()).view() != kMcapMagic) {
    throw InputError(shown, "this is not an MCAP file: it does not begin with the format's mark",
                     "Give a file that ends with .mcap, or a bag of another kind.");
  }
  return file;
}

bool HasEndMark(const RandomAccessFile& file) {
  const std::size_t size = kMcapMagic.size();
  return file.size() >= 2 * size && file.Read(file.size() - size, size).view() == kMcapMagic;
}

}  // namespace

McapReader::McapReader(const std::filesystem::path& path, const std::filesystem::path& shown)
    : shown_(shown.empty() ? path : shown) {
  const auto file = OpenMcap(path, shown_);
  index_ = ReadMcapIndex(file, shown_);
  if (topics().empty()) {
    throw InputError(shown_,
                     "no channel is in the " + std::to_string(file->size()) + " bytes of the file",
                     "The recording was empty, or was cut off before the first message.");
  }
  report_ = std::move(index_.scan);
  if (!HasEndMark(*file) && !report_.damaged) {
    report_.warnings.push_back(shown_.string() +
                               ": the end of the file is cut off; all messages are there, only its "
                               "index is not");
  }
  stream_ = std::make_unique<McapStream>(file, shown_, index_.chunk_offsets,
                                         index_.was_scanned ? &again_ : &report_);
  selected_.assign(topics().size(), true);
  met_.assign(topics().size(), 0);
}

void McapReader::Select(const std::vector<std::size_t>& topics) {
  selected_.assign(selected_.size(), false);
  for (const std::size_t topic : topics) selected_.at(topic) = true;
}

bool McapReader::Next(RawMessage* message) {
  McapRecord record;
  while (stream_->Next(&record)) {
    if (record.opcode != McapOpcode::kMessage) continue;
    const auto found = ParseMcapMessage(record.content);
    const std::size_t* topic = found ? index_.topics.Find(found->channel_id) : nullptr;
    if (topic == nullptr || !selected_[*topic]) continue;
    ++met_[*topic];
    message->topic = *topic;
    message->recorded_ns = found->log_time_ns;
    message->bytes = FileBytes(found->data.size());
    std::memcpy(message->bytes.data(), found->data.data(), found->data.size());
    if (topics()[*topic].encoding == Encoding::kCdr && !UnpackMessage(&message->bytes)) {
      ++not_unpacked_;
      report_.damaged = true;
      report_.bytes_lost += found->data.size();
      continue;
    }
    return true;
  }
  if (!finished_) Finish();
  return false;
}

void McapReader::Finish() {
  finished_ = true;
  std::uint64_t listed = 0;
  std::uint64_t met = 0;
  for (std::size_t i = 0; i < met_.size(); ++i) {
    if (!selected_[i]) continue;
    listed += topics()[i].messages;
    met += met_[i];
  }
  if (met < listed) {
    report_.damaged = true;
    report_.warnings.push_back(shown_.string() + ": the file lists " + CountOf(listed, "message") +
                               " of the topics that are read, " + std::to_string(met) +
                               (met == 1 ? " was found" : " were found"));
  }
  if (not_unpacked_ > 0) {
    report_.warnings.push_back(shown_.string() + ": " +
                               CountOf(not_unpacked_, "message is", "messages are") +
                               " broken where compressed");
  }
}

}  // namespace trajlo
