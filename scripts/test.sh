#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what is missing, builds Release, and runs the tests.
#   scripts/test.sh                  all tests
#   scripts/test.sh --label fast     only those with a label
# Further arguments go to ctest, for instance `-R Config`.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
build="${TRAJLO_BUILD_DIR:-$root/build}"

ctest_arguments=()
while [[ $# -gt 0 ]]; do
  case "$1" in
    --label)
      [[ $# -ge 2 ]] || { echo "test.sh: --label needs a value: fast or slow" >&2; exit 1; }
      ctest_arguments+=(--label-regex "^$2$")
      shift 2
      ;;
    -h | --help)
      sed -n '3,6p' "${BASH_SOURCE[0]}" | sed 's/^# \{0,1\}//'
      exit 0
      ;;
    *)
      ctest_arguments+=("$1")
      shift
      ;;
  esac
done

"$root/scripts/install_dependencies.sh"
export TRAJLO_CMAKE_ARGUMENTS="-DTRAJLO_BUILD_PYTHON=ON ${TRAJLO_CMAKE_ARGUMENTS:-}"
"$root/scripts/build.sh"
# A test that hangs is a failure, not a reason to wait for ever; but a busy machine is slow.
if ! ctest --test-dir "$build" --parallel "$(nproc)" --timeout 1800 --output-on-failure \
  --no-tests=error "${ctest_arguments[@]}"; then
  # Thousands of lines may lie between a failure and here: the ends of what the failed ones printed.
  awk '/^[0-9]+\/[0-9]+ Testing: / { count = 0; failed = 0 }
       { line[count++ % 30] = $0 }
       /^Test Failed\.$/ { failed = 1 }
       /time elapsed: / && failed {
         print ""
         for (i = count > 30 ? count - 30 : 0; i < count; ++i) print line[i % 30]
       }' "$build/Testing/Temporary/LastTest.log"
  exit 1
fi
