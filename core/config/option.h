// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "core/config/config.h"

namespace YAML {
class Node;
}

namespace trajlo {

// What an option is bound to: a field of one RunConfig, and what it may hold.
struct FlagField {
  bool* value;
};
struct IntegerField {
  int* value;
  int min, max;
};
struct RealField {
  double* value;
  double min, max;
};
struct TextField {
  std::function<std::string()> get;
  std::function<void(const std::string&)> set;
  bool is_path = false;
};
/// One of a few names; `get` and `set` work on the index of the name.
struct ChoiceField {
  std::vector<std::string> names;
  std::function<std::size_t()> get;
  std::function<void(std::size_t)> set;
};
struct ExtrinsicsField {
  std::vector<SE3>* value;
};
/// One value for all LiDARs, or a list with one for each.
struct ListField {
  using Element = std::variant<RealField, TextField, ChoiceField>;
  bool may_be_empty;
  std::function<std::size_t()> size;
  std::function<void(std::size_t)> resize;
  std::function<Element(std::size_t)> at;
};

struct Option {
  std::string key;
  std::string doc;
  std::variant<FlagField, IntegerField, RealField, TextField, ChoiceField, ExtrinsicsField,
               ListField>
      field;
};

/// The one list of all options, bound to the fields of `config`, which must outlive them.
/// Options of a section follow each other.
std::vector<Option> BindOptions(RunConfig* config);

/// What a section such as "window" is about; empty if there is nothing to say.
std::string SectionDoc(const std::string& section);

/// Takes the value from YAML. Throws ValueError.
void SetOption(const YAML::Node& node, const Option& option);
/// The value as YAML in one line; lists as a flow sequence.
std::string ValueText(const Option& option);
/// What the option may hold, in words.
std::string AllowedText(const Option& option);
/// The words that the option, or each element of a list, may be; empty for numbers and texts.
std::vector<std::string> ChoicesOf(const Option& option);

/// A value that an option cannot take; becomes a ConfigError where file and key are known.
struct ValueError {
  std::string what;
  int line, column;  ///< From 1, as in an editor; 0 if unknown.
};

}  // namespace trajlo
