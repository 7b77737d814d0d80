// SPDX-License-Identifier: MIT
// Values of options from YAML and to YAML.
#include <algorithm>

#include "core/config/extrinsics_yaml.h"
#include "core/config/option.h"
#include "core/config/yaml_scalars.h"
#include "core/options/did_you_mean.h"

namespace trajlo {
namespace {

template <class... Visitors>
struct Overloaded : Visitors... {
  using Visitors::operator()...;
};
template <class... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;

std::string Join(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " | ") + word;
  return text;
}

/// The number of `node` within the bounds of `field`, or a ValueError.
template <typename Number, typename Field>
Number NumberWithin(const YAML::Node& node, const Field& field, const Option& option) {
  Number number{};
  if (!ParseFinite(node.Scalar(), &number) || !(number >= field.min && number <= field.max)) {
    throw ErrorAt(node, "must be " + AllowedText(option) + ", found '" + node.Scalar() + "'");
  }
  return number;
}

bool ParseFlag(const YAML::Node& node) {
  for (const char* word : {"true", "yes", "on"}) {
    if (node.Scalar() == word) return true;
  }
  for (const char* word : {"false", "no", "off"}) {
    if (node.Scalar() == word) return false;
  }
  throw ErrorAt(node, "must be true or false, found '" + node.Scalar() + "'");
}

std::size_t ParseChoice(const YAML::Node& node, const ChoiceField& field) {
  const auto found = std::find(field.names.begin(), field.names.end(), node.Scalar());
  if (found != field.names.end()) return static_cast<std::size_t>(found - field.names.begin());
  throw ErrorAt(node, "must be one of " + Join(field.names) + ", found '" + node.Scalar() + "'" +
                          DidYouMean(node.Scalar(), field.names));
}

/// The element of a list as an option of its own.
Option At(const Option& option, const ListField& field, std::size_t i) {
  return std::visit(
      [&](auto element) {
        return Option{option.key, option.doc, element};
      },
      field.at(i));
}

void SetList(const YAML::Node& node, const ListField& field, const Option& option) {
  if (node.IsSequence() && (node.size() > 0 || field.may_be_empty)) {
    field.resize(node.size());
    for (std::size_t i = 0; i < node.size(); ++i) SetOption(node[i], At(option, field, i));
    return;
  }
  const bool empties = node.IsNull() || (node.IsScalar() && node.Scalar().empty());
  field.resize(field.may_be_empty && empties ? 0 : 1);
  if (field.size() == 1) SetOption(node, At(option, field, 0));
}

std::string ListText(const ListField& field, const Option& option) {
  if (field.size() == 1) return ValueText(At(option, field, 0));
  std::string text;
  for (std::size_t i = 0; i < field.size(); ++i) {
    text += (i > 0 ? ", " : "") + ValueText(At(option, field, i));
  }
  return "[" + text + "]";
}

/// The first element of a list, whether or not there is one, given to `ask`.
template <typename Ask>
auto OfFirst(const ListField& field, const Option& option, const Ask& ask) {
  const std::size_t size = field.size();
  if (size == 0) field.resize(1);
  auto answer = ask(At(option, field, 0));
  field.resize(size);
  return answer;
}

std::string Quoted(const std::string& text) {
  YAML::Emitter emitter;
  emitter.SetStringFormat(YAML::DoubleQuoted);
  emitter << text;
  return emitter.c_str();
}

}  // namespace

void SetOption(const YAML::Node& node, const Option& option) {
  if (const auto* extrinsics = std::get_if<ExtrinsicsField>(&option.field)) {
    *extrinsics->value = ParseExtrinsics(node);
    return;
  }
  if (const auto* list = std::get_if<ListField>(&option.field)) {
    return SetList(node, *list, option);
  }
  const auto* text = std::get_if<TextField>(&option.field);
  if (text != nullptr && node.IsNull()) return text->set("");
  if (!node.IsScalar()) {
    throw ErrorAt(node, std::string(node.IsNull() ? "has no value" : "takes a single value") +
                            "; it must be " + AllowedText(option));
  }
  std::visit(
      Overloaded{
          [&](const FlagField& field) { *field.value = ParseFlag(node); },
          [&](const IntegerField& field) { *field.value = NumberWithin<int>(node, field, option); },
          [&](const RealField& field) { *field.value = NumberWithin<double>(node, field, option); },
          [&](const TextField& field) { field.set(node.Scalar()); },
          [&](const ChoiceField& field) { field.set(ParseChoice(node, field)); },
          [](const ExtrinsicsField&) {},
          [](const ListField&) {},
      },
      option.field);
}

std::string ValueText(const Option& option) {
  return std::visit(
      Overloaded{
          [](const FlagField& field) { return std::string(*field.value ? "true" : "false"); },
          [](const IntegerField& field) { return std::to_string(*field.value); },
          [](const RealField& field) { return NumberText(*field.value); },
          [](const TextField& field) { return Quoted(field.get()); },
          [](const ChoiceField& field) { return field.names[field.get()]; },
          [](const ExtrinsicsField& field) {
            std::string text;
            for (const SE3& T : *field.value) text += (text.empty() ? "" : ", ") + ExtrinsicText(T);
            return "[" + text + "]";
          },
          [&](const ListField& field) { return ListText(field, option); },
      },
      option.field);
}

std::string AllowedText(const Option& option) {
  return std::visit(
      Overloaded{
          [](const FlagField&) { return std::string("true or false"); },
          [](const IntegerField& field) { return RangeText(field.min, field.max); },
          [](const RealField& field) { return RangeText(field.min, field.max); },
          [](const TextField&) { return std::string("text"); },
          [](const ChoiceField& field) { return Join(field.names); },
          [](const ExtrinsicsField&) { return std::string("a list, one transform per LiDAR"); },
          [&](const ListField& field) {
            return OfFirst(field, option, AllowedText) + ", or a list with one per LiDAR";
          },
      },
      option.field);
}

std::vector<std::string> ChoicesOf(const Option& option) {
  if (std::holds_alternative<FlagField>(option.field)) return {"true", "false"};
  if (const auto* choice = std::get_if<ChoiceField>(&option.field)) return choice->names;
  const auto* list = std::get_if<ListField>(&option.field);
  return list == nullptr ? std::vector<std::string>() : OfFirst(*list, option, ChoicesOf);
}

}  // namespace trajlo
