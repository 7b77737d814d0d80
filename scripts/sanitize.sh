#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds with sanitizers and runs the tests and five short runs.
#   scripts/sanitize.sh asan           addresses and undefined behaviour (clang), in build-asan
#   scripts/sanitize.sh tsan           threads, in build-tsan, with a oneTBB built for it
#   scripts/sanitize.sh tsan --fast    only the tests with the label fast, and the five runs
#   scripts/sanitize.sh asan --slice   few parts only: see below
# The five runs: a folder, a bag, two LiDARs, motion-corrected scans (KITTI), a bag that is cut.
# The slow tests are long runs of the odometry, which take hours here.
# The slice is what continuous integration has time for: the whole method, on the random scans of the
# fuzz targets (tests/fuzz/corpus), with one thread and with four.
# A report of a sanitizer ends the program with a code that none of its own exits has.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
jobs="${TRAJLO_JOBS:-$(nproc)}"

usage() { sed -n '3,12p' "${BASH_SOURCE[0]}" | sed 's/^# \{0,1\}//'; }
kind="${1:-}"
part="${2:-}"
case "$kind" in
  asan | tsan) ;;
  -h | --help)
    usage
    exit 0
    ;;
  *)
    usage >&2
    exit 1
    ;;
esac
case "$part" in
  '' | --fast | --slice) ;;
  *)
    usage >&2
    exit 1
    ;;
esac
build="${TRAJLO_BUILD_DIR:-$root/build-$kind}"

export ASAN_OPTIONS="exitcode=86:detect_stack_use_after_return=1:${ASAN_OPTIONS:-}"
export UBSAN_OPTIONS="exitcode=86:print_stacktrace=1:${UBSAN_OPTIONS:-}"
export TSAN_OPTIONS="exitcode=86:suppressions=$root/tests/tsan.supp:${TSAN_OPTIONS:-}"

# The thread sanitizer must see how oneTBB synchronises: tests/tsan.supp tells why.
build_tbb() {
  local folder="$build/tbb"
  if [[ ! -e "$folder/lib/libtbb.so.12" ]]; then
    mkdir -p "$folder/lists/partial"
    # Debian's sources, whatever the machine's own lists say.
    echo "deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg]" \
      "http://deb.debian.org/debian bookworm main" >"$folder/debian.list"
    local apt=(apt-get -q -o Dir::Etc::SourceList="$folder/debian.list" -o Dir::Etc::SourceParts=-
      -o Dir::State::Lists="$folder/lists" -o APT::Sandbox::User=)
    (cd "$folder" && "${apt[@]}" update && "${apt[@]}" source onetbb)
    cmake -S "$folder"/onetbb-* -B "$folder/build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo \
      -DTBB_SANITIZE=thread -DTBB_TEST=OFF -DTBBMALLOC_BUILD=OFF -DTBB_STRICT=OFF \
      -DCMAKE_CXX_FLAGS=-Wno-tsan >/dev/null
    cmake --build "$folder/build" --parallel "$jobs" --target tbb
    # It chooses the name of the folder by itself.
    ln -sfn "$(dirname "$(find "$folder/build" -name libtbb.so.12)")" "$folder/lib"
    [[ -e "$folder/lib/libtbb.so.12" ]] || { echo "sanitize.sh: oneTBB was not built" >&2; exit 1; }
  fi
  export LD_LIBRARY_PATH="$folder/lib:${LD_LIBRARY_PATH:-}"
}

build_targets() {
  cmake -S "$root" --preset "$kind" -B "$build" >/dev/null
  cmake --build "$build" --parallel "$jobs" "$@"
}

run_slice() {
  build_targets --target fuzz_odometry fuzz_segmenter
  ctest --test-dir "$build" --parallel "$jobs" --timeout 3600 --output-on-failure \
    --no-tests=error -R '^fuzz\.(odometry|segmenter)$'
}

# expect CODE NAME ARGUMENTS...: one trajlo_run.
expect() {
  local wanted="$1" name="$2" code=0
  shift 2
  "$build/apps/trajlo_run" --output="$folder/$name" "$@" >"$folder/$name.log" 2>&1 || code=$?
  if [[ "$code" -ne "$wanted" ]]; then
    cat "$folder/$name.log" >&2
    echo "sanitize.sh: the run '$name' ended with $code, not with $wanted" >&2
    exit 1
  fi
  echo "ok      the run '$name' ended with $code"
}

run_five() {
  folder="$(mktemp -d -t trajlo_sanitize.XXXXXX)"
  trap 'rm -rf "$folder"' EXIT
  local simulate="$build/apps/trajlo_simulate"
  "$simulate" --scenario=hall_os1_16 --duration_s=2 --output="$folder/in_folder" >/dev/null
  "$simulate" --scenario=hall_os1_16 --duration_s=2 --format=bag --bag_compression=lz4 \
    --output="$folder/in_bag" >/dev/null
  "$simulate" --scenario=hall_os1_16x2 --duration_s=2 --output="$folder/in_two" >/dev/null
  "$simulate" --scenario=street_kitti --duration_s=2 --output="$folder/in_kitti" >/dev/null
  head -c 5000000 "$folder/in_bag/recording.bag" >"$folder/cut.bag"
  expect 0 folder --input="$folder/in_folder"
  expect 0 bag --input="$folder/in_bag/recording.bag"
  expect 0 two --input="$folder/in_two" --config="$folder/in_two/rig.yaml"
  expect 0 kitti --input="$folder/in_kitti" --config="$root/config/datasets/kitti.yaml"
  expect 3 damaged --input="$folder/cut.bag"
}

[[ "$kind" == asan ]] || build_tbb
if [[ "$part" == --slice ]]; then
  run_slice
else
  build_targets
  label=()
  [[ -z "$part" ]] || label=(--label-regex '^fast$')
  ctest --test-dir "$build" --parallel "$jobs" --timeout 3600 --output-on-failure --no-tests=error \
    -E '^scripts\.' "${label[@]}"
  run_five
fi
echo "sanitize.sh: $kind found nothing"
