// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/config/option.h"
#include "core/options/describe.h"

namespace trajlo {

/// The describer of options structs (see core/options/describe.h) that makes options, each bound to
/// the field that it is given.
class OptionBinder {
 public:
  /// The options that follow are of this section; empty for none.
  OptionBinder& In(const std::string& section) {
    section_ = section;
    return *this;
  }

  void operator()(OptionFor audience, const char* name, bool& value, const char* doc) {
    Push(audience, name, doc, FlagField{&value});
  }

  void operator()(OptionFor audience, const char* name, int& value, Range<int> range,
                  const char* doc) {
    Push(audience, name, doc, IntegerField{&value, range.min, range.max});
  }

  void operator()(OptionFor audience, const char* name, double& value, Range<double> range,
                  const char* doc) {
    Push(audience, name, doc, RealField{&value, range.min, range.max});
  }

  void operator()(OptionFor audience, const char* name, std::string& value, const char* doc) {
    Push(audience, name, doc,
         TextField{[&value] { return value; }, [&value](const auto& s) { value = s; }});
  }

  void operator()(OptionFor audience, const char* name, std::filesystem::path& value,
                  const char* doc) {
    Push(audience, name, doc,
         TextField{[&value] { return value.string(); }, [&value](const auto& s) { value = s; },
                   true});
  }

  void operator()(OptionFor audience, const char* name, std::vector<SE3>& value, const char* doc) {
    Push(audience, name, doc, ExtrinsicsField{&value});
  }

  template <typename Value>
  void operator()(OptionFor audience, const char* name, Value& value, const Names<Value>& names,
                  const char* doc) {
    Push(audience, name, doc,
         Choice(
             names, [&value]() -> Value { return value; },
             [&value](Value chosen) { value = chosen; }));
  }

  void operator()(OptionFor audience, const char* name, std::vector<std::string>& values,
                  const char* doc) {
    Push(audience, name, doc,
         List(values, true, [&values](std::size_t i) { return TextAt(values, i); }));
  }

  void operator()(OptionFor audience, const char* name, PerLidar<std::string>& value,
                  const char* doc) {
    auto& values = value.values;
    Push(audience, name, doc,
         List(values, false, [&values](std::size_t i) { return TextAt(values, i); }));
  }

  void operator()(OptionFor audience, const char* name, PerLidar<double>& value,
                  Range<double> range, const char* doc) {
    auto& values = value.values;
    Push(audience, name, doc, List(values, false, [&values, range](std::size_t i) {
           return RealField{&values[i], range.min, range.max};
         }));
  }

  template <typename Value>
  void operator()(OptionFor audience, const char* name, PerLidar<Value>& value,
                  const Names<Value>& names, const char* doc) {
    auto& values = value.values;
    Push(audience, name, doc, List(values, false, [&values, names](std::size_t i) {
           return Choice(
               names, [&values, i]() -> Value { return values[i]; },
               [&values, i](Value chosen) { values[i] = chosen; });
         }));
  }

  std::vector<Option> options;

 private:
  template <typename Value, typename At>
  static ListField List(std::vector<Value>& values, bool may_be_empty, At at) {
    return {may_be_empty, [&values] { return values.size(); },
            [&values](std::size_t size) { values.resize(size); }, at};
  }

  static TextField TextAt(std::vector<std::string>& values, std::size_t i) {
    return {[&values, i] { return values[i]; },
            [&values, i](const std::string& text) { values[i] = text; }};
  }

  template <typename Value, typename Get, typename Set>
  static ChoiceField Choice(const Names<Value>& names, Get get, Set set) {
    ChoiceField field;
    for (const auto& [name, meaning] : names) field.names.emplace_back(name);
    field.get = [names, get] {
      const auto found = std::find_if(names.begin(), names.end(),
                                      [&](const auto& name) { return name.second == get(); });
      return static_cast<std::size_t>(found - names.begin());
    };
    field.set = [names, set](std::size_t index) { set(names[index].second); };
    return field;
  }

  template <typename Field>
  void Push(OptionFor audience, const std::string& name, const char* doc, Field field) {
    options.push_back({OptionKey(audience, section_, name), doc, std::move(field)});
  }

  std::string section_;
};

}  // namespace trajlo
