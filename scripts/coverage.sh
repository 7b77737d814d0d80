#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Prints file by file which share of the lines of manifolds, factors, core/scans and core/odometry
# their own tests run, and which lines none runs; ends with 1 where a layer is below 90 %. Builds in
# build-coverage.
# Simulated recordings (golden trajectories, pauses) do not count: they run nearly every line, and
# would hide what has no test.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
cd "$root"
build="${TRAJLO_BUILD_DIR:-$root/build-coverage}"
jobs="${TRAJLO_JOBS:-$(nproc)}"
if [[ $# -gt 0 ]]; then
  sed -n '3,7p' "${BASH_SOURCE[0]}" | sed 's/^# \{0,1\}//'
  [[ "$1" == -h || "$1" == --help ]] && exit 0
  exit 1
fi
layers=(manifolds factors core/scans core/odometry)

mapfile -t tests < <(find "${layers[@]/#/tests/}" -name '*_test.cc' -exec basename -s .cc {} + |
  grep -vE '^(golden_trajectory|pauses)_test$' | sort)
cmake --preset coverage -B "$build" >/dev/null
cmake --build "$build" --parallel "$jobs" --target "${tests[@]}"
# Counts of an earlier call would be added.
find "$build" -name '*.gcda' -delete
find "$build/tests" -type f -executable -print0 |
  grep -zE "/($(IFS='|' && echo "${tests[*]}"))\$" |
  xargs -0 -n 1 -P "$jobs" -I{} sh -c '{} --gtest_brief=1 >&2'

gcovr --root . --filter "^($(IFS='|' && echo "${layers[*]}"))/" --json "$build/coverage.json" \
  --object-directory "$build" "$build"
failed=0
for layer in "${layers[@]}"; do
  gcovr --root . --add-tracefile "$build/coverage.json" --filter "^$layer/" --fail-under-line 90 ||
    failed=1
done
exit "$failed"
