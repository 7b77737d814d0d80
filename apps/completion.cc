// SPDX-License-Identifier: MIT
#include "apps/completion.h"

#include <algorithm>

#include "apps/config_names.h"
#include "apps/read_flags.h"
#include "apps/usage_error.h"
#include "core/config/config.h"
#include "core/config/config_error.h"

namespace trajlo {
namespace {

using Words = std::vector<std::string>;

// Bash takes `=` for the end of a word, so only what follows the last one is replaced, and the word
// before is not always the last of COMP_WORDS.
constexpr char kBash[] = R"(_trajlo() {
  local line="${COMP_LINE:0:COMP_POINT}"
  local word="${line##*[[:space:]]}" kept="" before
  read -r -a before <<< "${line%"$word"}"
  [[ $word == *=* && $COMP_WORDBREAKS == *=* ]] && kept="${word%=*}="
  local IFS=$'\n'
  COMPREPLY=($("${COMP_WORDS[0]}" --complete "${before[-1]}" "$word" 2>/dev/null))
  COMPREPLY=("${COMPREPLY[@]#"$kept"}")
  [[ ${#COMPREPLY[@]} -eq 1 && $COMPREPLY == *= ]] && compopt -o nospace
}
complete -o default -F _trajlo trajlo_run trajlo_info trajlo_convert trajlo_evaluate \
  trajlo_simulate trajlo_compare_solvers
)";

constexpr char kZsh[] =
    R"(#compdef trajlo_run trajlo_info trajlo_convert trajlo_evaluate trajlo_simulate trajlo_compare_solvers
compdef _trajlo trajlo_run trajlo_info trajlo_convert trajlo_evaluate trajlo_simulate \
  trajlo_compare_solvers
_trajlo() {
  local -a found
  found=("${(@f)$("${words[1]}" --complete "${words[CURRENT-1]}" "$PREFIX" 2>/dev/null)}")
  if [[ -n "${found[1]}" ]]; then
    compadd -S '' -- "${found[@]}"
  else
    compset -P '*='
    _files
  fi
}
if [[ "${funcstack[1]}" == _trajlo ]]; then _trajlo; fi
)";

/// A switch that is on by itself is offered as the one that turns it off.
Words FlagWords(const Command& command) {
  Words words = {"--help", "--version"};
  for (const gflags::CommandLineFlagInfo& flag : FlagsOf(command.name)) {
    const bool is_switch = flag.type == "bool";
    words.push_back((is_switch && flag.default_value == "true" ? "--no" : "--") + flag.name +
                    (is_switch ? "" : "="));
  }
  return words;
}

Words ValuesOf(const Command& command, const std::string& flag) {
  Words values = command.values ? command.values(flag) : Words();
  if (!values.empty()) return values;
  if (flag == "config") {
    for (const NamedConfig& config : NamedConfigs()) values.push_back(config.name);
  } else if (flag == "set") {
    for (const KeyInfo& key : ListKeys()) {
      if (key.choices.empty()) values.push_back(key.key + "=");
      for (const std::string& choice : key.choices) values.push_back(key.key + "=" + choice);
    }
  }
  return values;
}

Words BeginningWith(const std::string& beginning, const std::string& kept, const Words& words) {
  Words matches;
  for (const std::string& word : words) {
    if (word.compare(0, beginning.size(), beginning) == 0) matches.push_back(kept + word);
  }
  return matches;
}

/// The values of an option are offered when its `=` is there, and the options until then.
Words CutAtEquals(Words words) {
  for (std::string& word : words) word = word.substr(0, word.find('=') + 1);
  words.erase(std::unique(words.begin(), words.end()), words.end());
  return words;
}

/// Of "--config=ouster,in" everything up to the comma is kept.
Words CompleteValue(const Command& command, const std::string& flag, const std::string& kept,
                    const std::string& value) {
  const std::size_t comma = IsList(flag) ? value.rfind(',') : std::string::npos;
  const std::size_t begin = comma == std::string::npos ? 0 : comma + 1;
  const std::string beginning = value.substr(begin);
  Words values = ValuesOf(command, flag);
  if (flag == "set" && beginning.find('=') == std::string::npos) values = CutAtEquals(values);
  return BeginningWith(beginning, kept + value.substr(0, begin), values);
}

bool IsFlagOf(const Command& command, const std::string& name) {
  const auto flags = FlagsOf(command.name);
  return std::any_of(flags.begin(), flags.end(), [&](const gflags::CommandLineFlagInfo& flag) {
    return flag.name == name && flag.type != "bool";
  });
}

std::string NameIn(const std::string& word) {
  return LongName(word.substr(std::min(word.find_first_not_of('-'), word.size())));
}

}  // namespace

Words Complete(const Command& command, const std::string& previous, const std::string& word) {
  try {
    const std::size_t equals = word.find('=');
    const bool dashed = !word.empty() && word.front() == '-';
    if (dashed && equals == std::string::npos) return BeginningWith(word, "", FlagWords(command));
    if (dashed) {
      return CompleteValue(command, NameIn(word.substr(0, equals)), word.substr(0, equals + 1),
                           word.substr(equals + 1));
    }
    const bool is_value =
        previous.size() > 1 && previous.front() == '-' && IsFlagOf(command, NameIn(previous));
    return CompleteValue(command, is_value ? NameIn(previous) : "", "", word);
  } catch (const ConfigError&) {  // The configurations are not there.
    return {};
  }
}

std::string CompletionScript(const std::string& shell) {
  if (shell == "bash") return kBash;
  if (shell == "zsh") return kZsh;
  throw UsageError("--completion: must be bash or zsh, found '" + shell + "'");
}

}  // namespace trajlo
