// SPDX-License-Identifier: MIT
#include "core/io/messages/message_schema.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include "core/io/messages/wire_reader.h"
#include "core/io/messages/wire_writer.h"

namespace trajlo {
namespace {

constexpr std::string_view kBlanks = " \t\r";
/// Deeper than any interface.
constexpr int kDeepest = 20;
/// Parts of a message that take no bytes.
constexpr std::size_t kSpareSteps = 1'000'000;

/// "std_msgs/msg/Header" is "std_msgs/Header".
std::string WithoutMsg(std::string_view type) {
  std::string name(type);
  if (const auto at = name.find("/msg/"); at != std::string::npos) name.erase(at, 4);
  return name;
}

/// Takes the first line, and leaves out blanks at its ends and its comment.
std::string_view TakeLine(std::string_view* text) {
  const std::size_t end = std::min(text->find('\n'), text->size());
  std::string_view line = text->substr(0, end);
  text->remove_prefix(std::min(end + 1, text->size()));
  line = line.substr(0, line.find('#'));
  const std::size_t begin = line.find_first_not_of(kBlanks);
  if (begin == line.npos) return {};
  return line.substr(begin, line.find_last_not_of(kBlanks) + 1 - begin);
}

/// The text of each interface by its name; the first, without a name, is the message itself.
std::map<std::string, std::string_view> SplitInterfaces(std::string_view text) {
  std::map<std::string, std::string_view> parts;
  constexpr std::string_view kRule = "\n====";
  std::string name;
  while (true) {
    const std::size_t end = text.find(kRule);
    parts.emplace(name, text.substr(0, end));
    if (end == text.npos) return parts;
    text.remove_prefix(end + 1);
    TakeLine(&text);  // The rule.
    const std::string_view title = TakeLine(&text);
    const std::size_t colon = title.find(':');
    if (colon == title.npos) return parts;
    const std::size_t begin = title.find_first_not_of(kBlanks, colon + 1);
    name = begin == title.npos ? "" : WithoutMsg(title.substr(begin));
    // Of an interface without fields, the rule that follows begins its text.
    if (text.substr(0, 4) == "====") text = std::string_view(text.data() - 1, text.size() + 1);
  }
}

std::size_t BytesOf(std::string_view type) {
  static const std::map<std::string_view, std::size_t> sizes = {
      {"bool", 1},   {"byte", 1},    {"char", 1},   {"int8", 1},   {"uint8", 1},
      {"int16", 2},  {"uint16", 2},  {"int32", 4},  {"uint32", 4}, {"int64", 8},
      {"uint64", 8}, {"float32", 4}, {"float64", 8}};
  const auto found = sizes.find(type);
  return found == sizes.end() ? 0 : found->second;
}

bool BeginsWith(std::string_view text, std::string_view word) {
  return text.substr(0, word.size()) == word;
}

}  // namespace

class MessageSchema::Parser {
 public:
  explicit Parser(std::string_view text) : texts_(SplitInterfaces(text)) {}

  bool Parse(std::string_view type) {
    texts_[WithoutMsg(type)] = texts_[""];
    return IndexOf(WithoutMsg(type), 0).has_value();
  }
  std::vector<Type> Take() { return std::move(types_); }

 private:
  std::optional<std::size_t> IndexOf(const std::string& name, int depth) {
    const auto known = indices_.find(name);
    if (known != indices_.end()) return known->second;
    const auto text = texts_.find(name);
    if (text == texts_.end() || depth > kDeepest) return {};
    const std::size_t index = types_.size();
    indices_[name] = index;
    types_.emplace_back();
    std::string_view rest = text->second;
    while (!rest.empty()) {
      const std::string_view line = TakeLine(&rest);
      if (line.empty()) continue;
      const std::size_t blank = line.find_first_of(kBlanks);
      if (blank == line.npos) return {};
      if (IsConstant(line.substr(blank))) continue;
      const auto field = FieldOf(line.substr(0, blank), name, depth);
      if (!field) return {};
      types_[index].push_back(*field);
    }
    return index;
  }

  /// "X=1" or "X = 1"; a default value ("x 1", "x '='") belongs to a field.
  static bool IsConstant(std::string_view rest) {
    const std::string_view name = rest.substr(rest.find_first_not_of(kBlanks));
    const std::size_t end = std::min(name.find_first_of(" \t="), name.size());
    const std::size_t next = name.find_first_not_of(kBlanks, end);
    return next != name.npos && name[next] == '=';
  }

  std::optional<Field> FieldOf(std::string_view type, const std::string& parent, int depth) {
    Field field;
    if (const std::size_t bracket = type.find('['); bracket != type.npos) {
      const std::string_view inside = type.substr(bracket + 1, type.find(']') - bracket - 1);
      field.array = Array::kSequence;
      if (!inside.empty() && inside.front() != '<') {
        field.array = Array::kFixed;
        const char* end = inside.data() + inside.size();
        if (std::from_chars(inside.data(), end, field.count).ptr != end) return {};
      }
      type = type.substr(0, bracket);
    }
    const std::string name = WithoutMsg(type);
    field.bytes = BytesOf(name);
    if (field.bytes > 0) return field;
    if (name == "string" || BeginsWith(name, "string<=")) {
      field.kind = Kind::kString;
    } else if (name == "time" || name == "duration" || name == "builtin_interfaces/Time" ||
               name == "builtin_interfaces/Duration") {
      field.kind = Kind::kTime;
    } else if (name == "Header" || name == "std_msgs/Header") {
      field.kind = Kind::kHeader;
    } else {
      const std::string package = parent.substr(0, parent.find('/') + 1);
      const bool is_whole = name.find('/') != name.npos;
      const auto nested = IndexOf(is_whole ? name : package + name, depth + 1);
      if (!nested) return {};
      field.kind = Kind::kNested;
      field.nested = *nested;
    }
    return field;
  }

  std::map<std::string, std::string_view> texts_;
  std::map<std::string, std::size_t> indices_;
  std::vector<Type> types_;
};

class MessageSchema::Rewriter {
 public:
  Rewriter(const std::vector<Type>& types, std::string_view bytes, Encoding from, Encoding to)
      : types_(types), in_(bytes, from), out_(to), steps_left_(kSpareSteps + bytes.size()) {}

  std::optional<std::string> Run() {
    Copy(0, 0);
    // CDR may be filled up to a multiple of four.
    if (!in_.ok() || in_.remaining() > (in_.is_cdr() ? 3 : 0)) return {};
    return out_.Take();
  }

 private:
  void Copy(std::size_t type, int depth) {
    // Broken interfaces may contain themselves, or arrays without end of what takes no bytes.
    if (depth > kDeepest || steps_left_ == 0) return Fail();
    --steps_left_;
    // CDR knows no structure without members.
    if (types_[type].empty()) {
      if (in_.is_cdr()) in_.Read<std::uint8_t>();
      if (out_.is_cdr()) out_.Put(std::uint8_t{0});
    }
    for (const Field& field : types_[type]) {
      std::size_t count = field.count;
      if (field.array == Array::kSequence) {
        count = CopyNumber<std::uint32_t>();
        // Every element has a byte at least.
        if (count > in_.remaining()) return Fail();
      }
      if (field.kind == Kind::kNumber) {
        CopyNumbers(field.bytes, count);
      } else {
        for (std::size_t i = 0; i < count && in_.ok(); ++i) CopyOne(field, depth);
      }
    }
  }

  void Fail() { in_.ReadBytes(in_.remaining() + 1); }

  template <typename T>
  T CopyNumber() {
    const T value = in_.Read<T>();
    out_.Put(value);
    return value;
  }

  void CopyNumbers(std::size_t bytes, std::size_t count) {
    if (bytes == 1) {
      out_.PutBytes(in_.ReadBytes(count));
      return;
    }
    for (std::size_t i = 0; i < count && in_.ok(); ++i) {
      if (bytes == 2) CopyNumber<std::uint16_t>();
      if (bytes == 4) CopyNumber<std::uint32_t>();
      if (bytes == 8) CopyNumber<std::uint64_t>();
    }
  }

  void CopyOne(const Field& field, int depth) {
    switch (field.kind) {
      case Kind::kNumber:
        return CopyNumbers(field.bytes, 1);
      case Kind::kString:
        out_.PutString(in_.ReadString());
        return;
      case Kind::kHeader:
        if (!in_.is_cdr()) in_.Read<std::uint32_t>();
        if (!out_.is_cdr()) out_.Put(std::uint32_t{0});
        CopyNumbers(4, 2);
        out_.PutString(in_.ReadString());
        return;
      case Kind::kTime:
        return CopyNumbers(4, 2);
      case Kind::kNested:
        return Copy(field.nested, depth + 1);
    }
  }

  const std::vector<Type>& types_;
  WireReader in_;
  WireWriter out_;
  std::size_t steps_left_;
};

std::optional<MessageSchema> MessageSchema::Parse(std::string_view type, std::string_view text) {
  Parser parser(text);
  if (!parser.Parse(type)) return {};
  MessageSchema schema;
  schema.types_ = parser.Take();
  return schema;
}

std::optional<std::string> MessageSchema::Rewrite(std::string_view bytes, Encoding from,
                                                  Encoding to) const {
  return Rewriter(types_, bytes, from, to).Run();
}

}  // namespace trajlo
