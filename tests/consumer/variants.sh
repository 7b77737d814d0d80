#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Configures, without building, what can be left out: every target that remains finds what it needs. What
# is not there or too old is said by name.
set -euo pipefail
sources="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
folder="$(mktemp -d -t trajlo_variants.XXXXXX)"
trap 'rm -rf "$folder"' EXIT

fail() {
  echo "variants.sh: $*" >&2
  exit 1
}

configure() {
  rm -rf "$folder/build"
  cmake -S "$sources" -B "$folder/build" "$@" >"$folder/log" 2>&1
}
no_embree=-DCMAKE_DISABLE_FIND_PACKAGE_embree=ON

configure "$no_embree" || fail "without Embree: $(cat "$folder/log")"
cmake --build "$folder/build" --target help >"$folder/targets"
grep -q "trajlo_run$" "$folder/targets" || fail "without Embree there is no trajlo_run"
! grep "trajlo_simul" "$folder/targets" || fail "without Embree there is a simulator"

no_others=()
for package in yaml-cpp nlohmann_json gflags GTest benchmark BZip2 SQLite3 ZLIB embree; do
  no_others+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON")
done
# Ceres itself asks for gflags.
configure -DTRAJLO_ONLY_ODOMETRY=ON "${no_others[@]/*gflags*/-Wno-dev}" ||
  fail "the odometry alone: $(cat "$folder/log")"

! configure "$no_embree" -DTRAJLO_BUILD_SIMULATION=ON || fail "a simulator without Embree"
grep -q "Embree 3 or 4 was not found" "$folder/log" || fail "unclear: $(cat "$folder/log")"

mkdir "$folder/ceres"
echo "set(Ceres_FOUND TRUE)" >"$folder/ceres/CeresConfig.cmake"
printf 'set(PACKAGE_VERSION 2.0.0)\nset(PACKAGE_VERSION_COMPATIBLE TRUE)\n' \
  >"$folder/ceres/CeresConfigVersion.cmake"
! configure "-DCeres_DIR=$folder/ceres" || fail "Ceres 2.0 is taken"
grep -q "Ceres 2.1 or newer is needed (found: '2.0.0')" "$folder/log" || fail "unclear: $(cat "$folder/log")"
