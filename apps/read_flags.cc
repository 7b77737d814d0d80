// SPDX-License-Identifier: MIT
#include "apps/read_flags.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <utility>

#include "apps/usage_error.h"
#include "core/options/did_you_mean.h"
#include "core/options/edit_distance.h"

namespace trajlo {
namespace {

using gflags::CommandLineFlagInfo;

/// A word that begins with a dash, taken apart.
struct FlagWord {
  std::string shown;  ///< As typed, without the value.
  std::string name;
  std::optional<std::string> value;
};

/// -0.5 and a lone dash are values or arguments.
bool IsFlag(const std::string& word) {
  if (word.size() < 2 || word[0] != '-') return false;
  return word[1] == '-' || std::isalpha(static_cast<unsigned char>(word[1])) != 0;
}

FlagWord TakeApart(const std::string& word) {
  FlagWord flag;
  const std::size_t equals = word.find('=');
  flag.shown = word.substr(0, equals);
  flag.name = LongName(flag.shown.substr(flag.shown.compare(0, 2, "--") == 0 ? 2 : 1));
  if (equals != std::string::npos) flag.value = word.substr(equals + 1);
  return flag;
}

/// The switch that the name negates: view of noview and of no_view; empty if there is none.
std::string Negated(const std::string& command, const std::string& name) {
  for (const CommandLineFlagInfo& known : FlagsOf(command)) {
    if (known.type != "bool") continue;
    if (name == "no" + known.name || name == "no_" + known.name) return known.name;
  }
  return "";
}

/// The first name that begins with the letter, as of -v and -q; empty if none does.
std::string ByLetter(char letter, const std::vector<std::string>& names) {
  const auto meant = std::find_if(names.begin(), names.end(), [&](const std::string& name) {
    return name[0] == std::tolower(static_cast<unsigned char>(letter));
  });
  return meant == names.end() ? "" : *meant;
}

[[noreturn]] void FailUnknown(const std::string& command, const FlagWord& flag) {
  std::vector<std::string> names = {"help", "version"};
  for (const CommandLineFlagInfo& known : FlagsOf(command)) names.push_back(known.name);
  const bool has_options = std::find(names.begin(), names.end(), "set") != names.end();
  std::string mend;
  if (const std::string negated = Negated(command, flag.name); !negated.empty()) {
    mend = flag.value ? " with a value; --" + negated + "=false, or --no" + negated + " alone"
                      : Suggestion(negated, "--no", "");
  } else if (flag.name.size() == 1) {
    mend = Suggestion(ByLetter(flag.name[0], names), "--", "");
  } else if (has_options && flag.name.find('.') != std::string::npos) {
    mend = "; options are set with --set " + flag.name + "=" + flag.value.value_or("VALUE");
  } else {
    mend = Suggestion(NearestKey(flag.name, names), "--", "");
  }
  throw UsageError("unknown flag " + flag.shown + mend);
}

/// The flag of that name; for --noquiet that of --quiet, with the value.
CommandLineFlagInfo Find(const std::string& command, FlagWord* flag) {
  for (const CommandLineFlagInfo& info : FlagsOf(command)) {
    if (info.name == flag->name) return info;
    const bool negated = info.type == "bool" && !flag->value && flag->name == "no" + info.name;
    if (!negated) continue;
    flag->value = "false";
    return info;
  }
  FailUnknown(command, *flag);
}

[[noreturn]] void FailWithoutValue(const std::string& name) {
  throw UsageError("--" + name + " needs a value: --" + name + "=...");
}

/// The value of a flag that stands without `=`; advances `i` if the next word is that value.
std::string NextValue(const CommandLineFlagInfo& info, const std::vector<std::string>& words,
                      std::size_t* i) {
  const std::string next = *i + 1 < words.size() ? words[*i + 1] : "--";
  const bool is_switch = info.type == "bool";
  if (is_switch && next != "true" && next != "false") return "true";
  if (IsFlag(next)) FailWithoutValue(info.name);
  ++*i;
  return next;
}

void Set(const std::string& name, const std::string& value, const std::string& type) {
  if (!gflags::SetCommandLineOption(name.c_str(), value.c_str()).empty()) return;
  static const std::map<std::string, const char*> kinds = {{"bool", "true or false"},
                                                           {"double", "a number"}};
  const auto kind = kinds.find(type);
  throw UsageError("--" + name + ": must be " +
                   (kind == kinds.end() ? "a whole number" : kind->second) + ", found '" + value +
                   "'");
}

struct Given {
  std::string value;
  std::string type;
};

void Note(const CommandLineFlagInfo& info, const std::string& value,
          std::map<std::string, Given>* given) {
  // From a variable of the shell that is not set, for instance.
  if (value.find_first_not_of(" ,") == std::string::npos) FailWithoutValue(info.name);
  const auto [at, is_new] = given->insert({info.name, {value, info.type}});
  std::string& before = at->second.value;
  if (is_new || before == value) return;
  if (!IsList(info.name)) {
    throw UsageError("--" + info.name + " is given twice, as '" + before + "' and as '" + value +
                     "'");
  }
  before += "," + value;
}

}  // namespace

std::string LongName(std::string_view name) {
  if (name == "o") return "output";
  if (name == "c") return "config";
  if (name == "h") return "help";
  std::string result(name);
  std::replace(result.begin(), result.end(), '-', '_');
  return result;
}

bool IsList(const std::string& flag) {
  static const std::vector<std::string> lists = {"config", "input", "inspect", "names",
                                                 "only",   "rpe",   "set",     "topics"};
  return std::find(lists.begin(), lists.end(), flag) != lists.end();
}

std::vector<CommandLineFlagInfo> FlagsOf(const std::string& command) {
  std::vector<CommandLineFlagInfo> all, own;
  gflags::GetAllFlags(&all);
  for (const CommandLineFlagInfo& flag : all) {
    const std::string file = flag.filename.substr(flag.filename.rfind('/') + 1);
    if (file == command + ".cc") own.push_back(flag);
  }
  return own;
}

std::vector<std::string> ReadFlags(const std::string& command,
                                   const std::vector<std::string>& words) {
  std::vector<std::string> arguments;
  std::map<std::string, Given> given;
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (words[i] == "--") {
      arguments.insert(arguments.end(), words.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                       words.end());
      break;
    }
    if (words[i].empty()) throw UsageError("an argument is empty");
    if (!IsFlag(words[i])) {
      arguments.push_back(words[i]);
      continue;
    }
    FlagWord flag = TakeApart(words[i]);
    const CommandLineFlagInfo info = Find(command, &flag);
    Note(info, flag.value ? *flag.value : NextValue(info, words, &i), &given);
  }
  for (const auto& [name, flag] : given) Set(name, flag.value, flag.type);
  return arguments;
}

}  // namespace trajlo
