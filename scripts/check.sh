#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Looks for faults without running anything.
#   scripts/check.sh                  everything; hours of one core, nearly all for clang-tidy
#   scripts/check.sh core/io apps     the slow part for these folders or files only
#   scripts/check.sh --fast           without the slow part: seconds
#   scripts/check.sh --slice          what continuous integration does: the slow part for two factors
#                                     and the headers they use
# The fast part, for all files: clang-format, SPDX lines, shellcheck, flake8's errors.
# The slow part: clang-tidy, which also gives clang's warnings. Those of g++ stop every build, and
# clang's stop those of scripts/sanitize.sh asan.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
build="${TRAJLO_BUILD_DIR:-build-clang}"
jobs="${TRAJLO_JOBS:-$(nproc)}"

to_tidy=(manifolds factors core apps tests)
case "${1:-}" in
  -h | --help)
    sed -n '3,11p' scripts/check.sh | sed 's/^# \{0,1\}//'
    exit 0
    ;;
  --fast)
    to_tidy=()
    ;;
  --slice)
    to_tidy=(factors/marginalization_prior.cc factors/point_to_plane.cc)
    ;;
  -*)
    echo "check.sh: $1 is no option; see --help" >&2
    exit 1
    ;;
  ?*)
    for name in "$@"; do
      [[ -e "$name" ]] || { echo "check.sh: there is no $name" >&2; exit 1; }
    done
    to_tidy=("${@%/}")
    ;;
esac

failed=()
# check NAME COMMAND...: goes on after a failure, so that all of them are seen at once.
check() {
  local name="$1" start="$SECONDS"
  shift
  if "$@"; then
    echo "ok      $name ($((SECONDS - start)) s)"
  else
    echo "FAILED  $name" >&2
    failed+=("$name")
  fi
}

# Those that git knows, and new ones that it does not ignore.
files() { git ls-files --cached --others --exclude-standard -- "$@"; }
# Files with a line like `#!/usr/bin/python3` at the top.
with_interpreter() {
  git grep --untracked -lIE "^#!.*$1" | while read -r file; do
    if head -n 1 "$file" | grep -qE "^#!.*$1"; then echo "$file"; fi
  done
}
cpp_files() { files '*.cc' '*.h'; }
python_files() { { files '*.py'; with_interpreter python3; } | sort -u; }

format() { cpp_files | xargs clang-format-14 --dry-run --Werror; }

# Every file that somebody writes, except those that cannot hold a comment or are prose:
# default.yaml and expert.yaml are what trajlo_run --show_config and --show_expert_config write.
spdx() {
  local missing
  missing="$({
    files '*.cc' '*.h' '*.py' '*.sh' '*.js' '*.css' '*.html' '*.cmake' '*CMakeLists.txt' \
      '*.yaml' '*Snakefile' '*.supp' 'scripts/packages*.txt' .clang-tidy \
      ':!*/fixtures/*' ':!*/fuzz/corpus/*' ':!config/default.yaml' ':!config/expert.yaml'
    with_interpreter '(bash|python3)'
  } | sort -u | while read -r file; do
    head -n 5 "$file" | grep -q 'SPDX-License-Identifier: MIT' || echo "  $file"
  done)"
  [[ -z "$missing" ]] || { printf 'No SPDX line:\n%s\n' "$missing" >&2; return 1; }
}

shell() { with_interpreter bash | xargs shellcheck; }
# Names that do not exist, are not used, or are defined twice; style is not its business.
python() { python_files | xargs flake8 --select=E9,F; }

# Those below files and folders that this machine compiles; a user's project (tests/consumer) is none.
compiled() {
  find "$@" -name '*.cc' | sort | while read -r file; do
    if grep -qF "\"file\": \"$PWD/$file\"" "$build/compile_commands.json"; then echo "$file"; fi
  done
}
tidy() {
  compiled "${to_tidy[@]}" |
    xargs --no-run-if-empty -n 1 -P "$jobs" clang-tidy-14 -p "$build" --quiet --warnings-as-errors='*' 2>&1 |
    grep -v 'warnings generated\.$'
  [[ "${PIPESTATUS[1]}" -eq 0 ]]
}

check clang-format format
check SPDX spdx
check shellcheck shell
check flake8 python
if [[ ${#to_tidy[@]} -gt 0 ]]; then
  # Only the commands of compilation are needed, and the one header that a build writes.
  cmake --preset clang -B "$build" >/dev/null
  cmake --build "$build" --target trajlo_git_version >/dev/null
  check "clang-tidy: ${to_tidy[*]}" tidy
fi
[[ ${#failed[@]} -eq 0 ]]
