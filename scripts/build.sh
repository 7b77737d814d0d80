#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Configures and builds Release in build/. Arguments go to `cmake --build`, for instance
# `--target trajlo_run`. TRAJLO_BUILD_DIR names another folder, TRAJLO_JOBS bounds the jobs,
# TRAJLO_CMAKE_ARGUMENTS has options for CMake, separated by blanks.
set -euo pipefail
if [[ "${1:-}" == -h || "${1:-}" == --help ]]; then
  sed -n '3,5p' "${BASH_SOURCE[0]}" | sed 's/^# \{0,1\}//'
  exit 0
fi
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
build="${TRAJLO_BUILD_DIR:-$root/build}"

# A job takes up to 1.5 GB: more jobs than the memory holds would be slower, or killed.
by_memory=$(($(awk '/MemAvailable/ {print $2}' /proc/meminfo) / 1500000))
jobs="${TRAJLO_JOBS:-$(nproc)}"
((by_memory >= 1)) || by_memory=1
((jobs <= by_memory)) || jobs="$by_memory"

read -ra options <<<"${TRAJLO_CMAKE_ARGUMENTS:-}"
cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release "${options[@]}"
cmake --build "$build" --parallel "$jobs" "$@"
