// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/config/option.h"

namespace trajlo {

/// What a number may be.
template <typename T>
struct Range {
  T min, max;
};

/// The words of a choice and what they mean.
template <typename Value>
using Names = std::vector<std::pair<const char*, Value>>;

/// Makes options, each bound to the field that it is given.
class OptionBinder {
 public:
  void Add(const char* key, bool& value, const char* doc) { Push(key, doc, FlagField{&value}); }

  void Add(const char* key, int& value, Range<int> range, const char* doc) {
    Push(key, doc, IntegerField{&value, range.min, range.max});
  }

  void Add(const char* key, double& value, Range<double> range, const char* doc) {
    Push(key, doc, RealField{&value, range.min, range.max});
  }

  void Add(const char* key, std::string& value, const char* doc) {
    Push(key, doc, TextField{[&value] { return value; }, [&value](const auto& s) { value = s; }});
  }

  void Add(const char* key, std::filesystem::path& value, const char* doc) {
    Push(key, doc,
         TextField{[&value] { return value.string(); }, [&value](const auto& s) { value = s; }});
  }

  void Add(const char* key, std::vector<SE3>& value, const char* doc) {
    Push(key, doc, ExtrinsicsField{&value});
  }

  template <typename Value>
  void Add(const char* key, Value& value, const Names<Value>& names, const char* doc) {
    Push(key, doc,
         Choice(
             names, [&value]() -> Value { return value; },
             [&value](Value chosen) { value = chosen; }));
  }

  void Add(const char* key, std::vector<std::string>& values, const char* doc) {
    Push(key, doc, List(values, true, [&values](std::size_t i) { return TextAt(values, i); }));
  }

  void Add(const char* key, PerLidar<std::string>& value, const char* doc) {
    auto& values = value.values;
    Push(key, doc, List(values, false, [&values](std::size_t i) { return TextAt(values, i); }));
  }

  void Add(const char* key, PerLidar<double>& value, Range<double> range, const char* doc) {
    auto& values = value.values;
    Push(key, doc, List(values, false, [&values, range](std::size_t i) {
           return RealField{&values[i], range.min, range.max};
         }));
  }

  template <typename Value>
  void Add(const char* key, PerLidar<Value>& value, const Names<Value>& names, const char* doc) {
    auto& values = value.values;
    Push(key, doc, List(values, false, [&values, names](std::size_t i) {
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
  void Push(const char* key, const char* doc, Field field) {
    options.push_back({key, doc, std::move(field)});
  }
};

}  // namespace trajlo
