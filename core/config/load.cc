// SPDX-License-Identifier: MIT
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <sstream>

#include "core/config/config_file.h"
#include "core/config/option.h"
#include "core/config/yaml_scalars.h"
#include "core/options/did_you_mean.h"
#include "core/options/edit_distance.h"

namespace trajlo {
namespace {

/// Walks nested maps and sets the options whose keys it meets.
class Loader {
 public:
  /// Without `with_places`, messages name no line: the text is a part of a command line. Relative
  /// paths are below `folder`, if there is one. Unknown keys are errors, unless there is a list
  /// that takes them.
  Loader(std::string name, bool with_places, RunConfig* config, std::filesystem::path folder = {},
         std::vector<std::string>* unknown = nullptr)
      : name_(std::move(name)),
        with_places_(with_places),
        folder_(std::move(folder)),
        options_(BindOptions(config)),
        unknown_(unknown) {}

  /// Sets one option, or complains about its key or value at the place of `key_node`.
  void Set(const std::string& key, const YAML::Node& key_node, const YAML::Node& value) {
    const Option* option = Find(key);
    if (option == nullptr && IsSection(key)) FailSection(key, key_node);
    if (option == nullptr && unknown_ != nullptr) return unknown_->push_back(key);
    if (option == nullptr) FailUnknown(key, key_node, value.IsMap());
    if (!seen_.insert(key).second) Fail(key_node, "'" + key + "' is set twice");
    try {
      SetOption(value, *option);
      Locate(*option);
    } catch (const ValueError& error) {
      throw ConfigError(Where(error), "'" + key + "' " + error.what);
    }
  }

  void Walk(const std::string& prefix, const YAML::Node& map) {
    for (const auto& entry : map) {
      if (!entry.first.IsScalar()) Fail(entry.first, "a key must be a word");
      const std::string key = prefix + entry.first.Scalar();
      if (!IsSection(key)) {
        Set(key, entry.first, entry.second);
      } else if (!seen_.insert(key).second) {
        Fail(entry.first, "the section '" + key + "' appears twice");
      } else if (entry.second.IsMap()) {
        Walk(key + ".", entry.second);
      } else if (!entry.second.IsNull()) {  // A section may be empty.
        FailSection(key, entry.second);
      }
    }
  }

  [[noreturn]] void Fail(const YAML::Node& node, const std::string& what) const {
    throw ConfigError(Where(ErrorAt(node, what)), what);
  }

 private:
  std::string Where(const ValueError& at) const {
    if (!with_places_ || at.line == 0) return name_;
    return name_ + ":" + std::to_string(at.line) + ":" + std::to_string(at.column);
  }

  void Locate(const Option& option) const {
    const auto* text = std::get_if<TextField>(&option.field);
    if (text == nullptr || !text->is_path || text->get().empty()) return;
    text->set((folder_ / text->get()).string());
  }

  const Option* Find(const std::string& key) const {
    const auto found = std::find_if(options_.begin(), options_.end(),
                                    [&](const Option& option) { return option.key == key; });
    return found == options_.end() ? nullptr : &*found;
  }

  bool IsSection(const std::string& key) const {
    return std::any_of(options_.begin(), options_.end(), [&](const Option& option) {
      return option.key.compare(0, key.size() + 1, key + ".") == 0;
    });
  }

  std::string KeysOf(const std::string& section) const {
    std::string text;
    for (const Option& option : options_) {
      if (option.key.compare(0, section.size() + 1, section + ".") != 0) continue;
      text += (text.empty() ? "" : ", ") + option.key;
    }
    return text;
  }

  [[noreturn]] void FailSection(const std::string& key, const YAML::Node& node) const {
    Fail(node, "'" + key + "' is a section, which holds the keys " + KeysOf(key));
  }

  /// What holds a map is meant as a section.
  [[noreturn]] void FailUnknown(const std::string& key, const YAML::Node& node,
                                bool is_section) const {
    std::vector<std::string> keys;
    for (const Option& option : options_) {
      if (!is_section) keys.push_back(option.key);
      for (std::size_t dot = option.key.find('.'); is_section && dot != std::string::npos;
           dot = option.key.find('.', dot + 1)) {
        keys.push_back(option.key.substr(0, dot));
      }
    }
    const std::string expert = "expert." + key;
    const std::string nearest =
        Find(expert) != nullptr || IsSection(expert) ? expert : NearestKey(key, keys);
    const std::string section = key.substr(0, key.find('.'));
    std::string mend = "; trajlo_run --show_config and --show_expert_config list all keys";
    if (!nearest.empty()) {
      mend = Suggestion(nearest);
    } else if (IsSection(section)) {
      mend = "; '" + section + "' has the keys " + KeysOf(section);
    }
    Fail(node, "unknown key '" + key + "'" + mend);
  }

  std::string name_;
  bool with_places_;
  std::filesystem::path folder_;
  std::vector<Option> options_;
  std::vector<std::string>* unknown_;
  std::set<std::string> seen_;
};

/// Splits at the commas that stand outside brackets, braces and quotes.
std::vector<std::string> SplitSettings(std::string_view text) {
  std::vector<std::string> parts(1);
  int depth = 0;
  char quote = 0;
  for (const char c : text) {
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '[' || c == '{') {
      ++depth;
    } else if (c == ']' || c == '}') {
      --depth;
    } else if (c == ',' && depth <= 0) {
      parts.emplace_back();
      continue;
    }
    parts.back() += c;
  }
  return parts;
}

std::string Trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\n");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(" \t\n") - begin + 1);
}

/// Notes where documents begin.
class DocumentStarts final : public YAML::EventHandler {
 public:
  std::vector<YAML::Mark> marks;

  void OnDocumentStart(const YAML::Mark& mark) override { marks.push_back(mark); }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t,
                const std::string&) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {}
  void OnMapEnd() override {}
};

std::string Place(const std::string& name, const YAML::Mark& mark) {
  return name + ":" + std::to_string(mark.line + 1) + ":" + std::to_string(mark.column + 1);
}

/// The one document of a text. (YAML::LoadAll would not end on texts such as ", a", where the
/// parser sees one empty document after the other at the same place.)
YAML::Node OnlyDocument(const std::string& yaml, const std::string& name) {
  const std::string broken = "this is not valid YAML: ";
  try {
    std::istringstream stream(yaml);
    YAML::Parser parser(stream);
    DocumentStarts starts;
    while (starts.marks.size() < 2 && parser.HandleNextDocument(starts)) {
    }
    if (starts.marks.size() < 2) return YAML::Load(yaml);
    const bool is_stuck = starts.marks[1].pos == starts.marks[0].pos;
    throw ConfigError(Place(name, starts.marks[1]),
                      is_stuck ? broken + "nothing can begin like this"
                               : "a second YAML document begins here; a file holds one");
  } catch (const YAML::Exception& error) {
    throw ConfigError(Place(name, error.mark), broken + error.msg);
  }
}

void LoadYaml(const std::string& yaml, const std::string& name, bool with_places, RunConfig* config,
              const std::filesystem::path& folder = {},
              std::vector<std::string>* unknown = nullptr) {
  const YAML::Node root = OnlyDocument(yaml, name);
  // Work on a copy: a file with an error changes nothing.
  RunConfig loaded = *config;
  Loader loader(name, with_places, &loaded, folder, unknown);
  if (root.IsNull()) return;
  if (!root.IsMap()) {
    loader.Fail(root, "expected sections with keys, such as 'window: {segments: 4}'");
  }
  loader.Walk("", root);
  *config = loaded;
}

/// Where the file is, also when the current folder is another one.
std::filesystem::path FolderOf(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::path whole = std::filesystem::absolute(file, error);
  return (error ? file : whole).parent_path();
}

/// A comma begins another setting, so that of "a=1,5" a 5 is left.
void RefuseDecimalComma(const std::string& before, const std::string& rest,
                        const std::string& name) {
  const auto is_digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  if (before.empty() || !is_digit(before.back()) || !is_digit(rest.front())) return;
  throw ConfigError(name, "'" + before + "," + rest + "': numbers need a point ('" + before + "." +
                              rest + "'), as a comma begins another key=value");
}

}  // namespace

void LoadConfigText(const std::string& yaml, const std::string& name, RunConfig* config) {
  LoadYaml(yaml, name, true, config);
}

void LoadConfigValues(const std::string& yaml, const std::string& name, RunConfig* config) {
  LoadYaml(yaml, name, false, config);
}

void LoadConfigFile(const std::filesystem::path& path, RunConfig* config) {
  LoadYaml(ReadConfigFile(path), path.string(), true, config, FolderOf(path));
}

std::vector<std::string> LoadRecordedConfig(const std::filesystem::path& path, RunConfig* config) {
  std::vector<std::string> unknown;
  LoadYaml(ReadConfigFile(path), path.string(), true, config, FolderOf(path), &unknown);
  return unknown;
}

void ApplyOverrides(std::string_view settings, RunConfig* config, const std::string& name) {
  RunConfig changed = *config;
  Loader loader(name, false, &changed);
  std::string before;
  for (const std::string& part : SplitSettings(settings)) {
    const std::string setting = Trimmed(part);
    if (setting.empty()) continue;
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos) {
      RefuseDecimalComma(before, setting, name);
      throw ConfigError(name, "expected key=value, found '" + setting + "'");
    }
    const std::string key = Trimmed(setting.substr(0, equals));
    const std::string value = setting.substr(equals + 1);
    YAML::Node node;
    try {
      node = YAML::Load(value);
    } catch (const YAML::Exception& error) {
      throw ConfigError(name, "'" + key + "' has a value that is not valid YAML: '" + value + "'");
    }
    loader.Set(key, YAML::Node(key), node);
    before = setting;
  }
  *config = changed;
}

}  // namespace trajlo
