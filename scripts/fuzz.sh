#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Looks for inputs that crash, hang or break a promise: libFuzzer with sanitizers (clang).
#   scripts/fuzz.sh                        all targets of tests/fuzz, a minute each
#   scripts/fuzz.sh pcd mcap --minutes 10  those two, ten minutes of a core's time each
#   scripts/fuzz.sh --list                 their names
# What is found is kept in build-asan/findings/TARGET; the exit code is 1 then. The growing corpus is
# kept in build-asan/corpus/TARGET, and the next call goes on from there.
# It shares its build with scripts/sanitize.sh asan. TRAJLO_BUILD_DIR names another build folder.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
build="${TRAJLO_BUILD_DIR:-$root/build-asan}"

minutes=1
targets=()
while [[ $# -gt 0 ]]; do
  case "$1" in
    --minutes)
      [[ "${2:-}" =~ ^[0-9]+$ ]] || { echo "fuzz.sh: --minutes needs a whole number" >&2; exit 1; }
      minutes="$2"
      shift 2
      ;;
    --list)
      basename --multiple --suffix=_fuzz.cc "$root"/tests/fuzz/*_fuzz.cc
      exit 0
      ;;
    -h | --help)
      sed -n '3,9p' "${BASH_SOURCE[0]}" | sed 's/^# \{0,1\}//'
      exit 0
      ;;
    -*)
      echo "fuzz.sh: $1 is no option; see --help" >&2
      exit 1
      ;;
    *)
      if [[ ! -f "$root/tests/fuzz/$1_fuzz.cc" ]]; then
        echo "fuzz.sh: there is no target $1; --list shows them" >&2
        exit 1
      fi
      targets+=("$1")
      shift
      ;;
  esac
done
[[ ${#targets[@]} -gt 0 ]] || mapfile -t targets < <("${BASH_SOURCE[0]}" --list)

command -v clang++ >/dev/null || {
  echo "fuzz.sh: clang++ was not found (apt install clang libclang-rt-14-dev)" >&2
  exit 1
}
cmake -S "$root" --preset asan -B "$build" >/dev/null
cmake --build "$build" --parallel "${TRAJLO_JOBS:-$(nproc)}" --target "${targets[@]/#/fuzz_}"

# Files that are written anew for each input do not need a disk.
[[ -w /dev/shm ]] && export TMPDIR="${TMPDIR:-/dev/shm}"
# A program that reads broken files must not believe the sizes in them. The seconds are those of a
# clock: a busy machine must not look like an endless loop.
limits=(-rss_limit_mb=2048 -malloc_limit_mb=1024 -timeout=1200)

# seed TARGET: the inputs of the tests begin the corpus; those of one name keep their folder's.
seed() {
  local file
  while read -r file; do
    [[ -z "$file" ]] ||
      cp --update "$file" "$build/corpus/$1/$(basename "$(dirname "$file")")_$(basename "$file")"
  done <"$build/tests/fuzz/$1.seeds"
}

# fuzz TARGET: a line of what it did; false if it found something. What counts is the time of the
# processor, which others may use, too: it goes on until that is reached.
fuzz() {
  local target="$1" corpus="$build/corpus/$1" findings="$build/findings/$1" log="$build/fuzz_$1.log"
  local result=clean used=0 inputs=0 took
  local TIMEFORMAT='%U %S'
  mkdir -p "$corpus" "$findings"
  seed "$target"
  while ((used < 60 * minutes)) && [[ "$result" == clean ]]; do
    { time "$build/tests/fuzz/fuzz_$target" "${limits[@]}" -print_final_stats=1 \
      -max_total_time=$((60 * minutes - used + 1)) -artifact_prefix="$findings/" \
      "$corpus" >"$log" 2>&1 || result=FOUND; } 2>"$log.time"
    read -r -a took <"$log.time"
    used="$(awk -v used="$used" -v user="${took[0]}" -v kernel="${took[1]}" \
      'BEGIN {print int(used + user + kernel + 1)}')"
    inputs=$((inputs + $(awk '/stat::number_of_executed_units/ {n = $2} END {print n + 0}' "$log")))
  done
  printf '%-16s %-5s  %4d s of a core  %9d inputs  %5d kept  %s\n' "$target" "$result" "$used" \
    "$inputs" "$(find "$corpus" -type f | wc -l)" "$log"
  [[ "$result" == clean ]]
}

failed=0
for target in "${targets[@]}"; do
  fuzz "$target" || failed=1
done
exit "$failed"
