#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Looks for faults without running anything.
#   scripts/check.sh                  everything; hours of one core, nearly all for clang-tidy
#   scripts/check.sh core/io apps     the slow part for these folders only
#   scripts/check.sh --fast           without the slow part: seconds
#   scripts/check.sh --slice          what continuous integration does: clang's warnings for the
#                                     method, clang-tidy for two factors and the headers they use
# The fast part, for all files: clang-format, SPDX lines, shellcheck, flake8's errors.
# The slow part: clang's warnings as errors (build-clang; those of g++ stop every build), clang-tidy.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
build="${TRAJLO_BUILD_DIR:-build-clang}"
jobs="${TRAJLO_JOBS:-$(nproc)}"

warn_folders=(manifolds factors core apps tests)
tidy_folders=("${warn_folders[@]}")
case "${1:-}" in
  -h | --help)
    sed -n '3,10p' scripts/check.sh | sed 's/^# \{0,1\}//'
    exit 0
    ;;
  --fast)
    warn_folders=()
    tidy_folders=()
    ;;
  --slice)
    warn_folders=(manifolds factors core/odometry)
    tidy_folders=(factors/marginalization_prior.cc factors/point_to_plane.cc)
    ;;
  -*)
    echo "check.sh: $1 is no option; see --help" >&2
    exit 1
    ;;
  ?*)
    for folder in "$@"; do
      [[ -d "$folder" ]] || { echo "check.sh: there is no folder $folder" >&2; exit 1; }
    done
    warn_folders=("${@%/}")
    tidy_folders=("${@%/}")
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

# Files with a line like `#!/usr/bin/python3` at the top.
with_interpreter() {
  git grep -lIE "^#!.*$1" | while read -r file; do
    if head -n 1 "$file" | grep -qE "^#!.*$1"; then echo "$file"; fi
  done
}
cpp_files() { git ls-files -- '*.cc' '*.h'; }
python_files() { { git ls-files -- '*.py'; with_interpreter python3; } | sort -u; }

format() { cpp_files | xargs clang-format-14 --dry-run --Werror; }

# Every file that somebody writes, except those that cannot hold a comment or are prose:
# default.yaml and expert.yaml are what trajlo_run --show_config and --show_expert_config write.
spdx() {
  local missing
  missing="$({
    git ls-files -- '*.cc' '*.h' '*.py' '*.sh' '*.js' '*.css' '*.html' '*.cmake' '*CMakeLists.txt' \
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

warnings() { cmake --build "$build" --parallel "$jobs" --target "${warn_folders[@]/%//all}" -- -k 0; }
tidy() {
  find "${tidy_folders[@]}" -name '*.cc' -not -path '*/fixtures/*' -print0 |
    xargs -0 -n 1 -P "$jobs" clang-tidy-14 -p "$build" --quiet --warnings-as-errors='*' 2>&1 |
    grep -v 'warnings generated\.$'
  [[ "${PIPESTATUS[1]}" -eq 0 ]]
}

check clang-format format
check SPDX spdx
check shellcheck shell
check flake8 python
if [[ ${#warn_folders[@]} -gt 0 ]]; then
  cmake --preset clang -B "$build" >/dev/null
  check "clang's warnings: ${warn_folders[*]}" warnings
  check "clang-tidy: ${tidy_folders[*]}" tidy
fi
[[ ${#failed[@]} -eq 0 ]]
