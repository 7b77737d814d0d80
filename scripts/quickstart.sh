#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# From a fresh Debian 12 machine to a trajectory, a map, the errors and a page of pictures, in one
# command: installs what is missing, builds, simulates a hand-held walk through an office, runs the
# odometry on it and evaluates it against the truth.
#   scripts/quickstart.sh [RECORDING]     with a recording of yours in place of the simulated one
# Results are in runs/quickstart (TRAJLO_RUNS names another folder for runs/).
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
build="${TRAJLO_BUILD_DIR:-$root/build}"
runs="${TRAJLO_RUNS:-$root/runs}/quickstart"
scenario="office_os0_64"

if [[ "${1:-}" == "-h" || "${1:-}" == "--help" ]]; then
  sed -n '3,7p' "${BASH_SOURCE[0]}" | sed 's/^# \{0,1\}//'
  exit 0
fi

"$root/scripts/install_dependencies.sh"
"$root/scripts/build.sh" --target trajlo_run trajlo_simulate trajlo_evaluate

mkdir -p "$runs"
result="$runs/result"
if [[ $# -ge 1 ]]; then
  "$build/apps/trajlo_run" --input="$1" --output="$result" --overwrite
  "$root/scripts/draw_run.py" "$result"
else
  recording="$runs/recording"
  "$build/apps/trajlo_simulate" --scenario="$scenario" --output="$recording" --overwrite
  "$build/apps/trajlo_run" --input="$recording" --config="$recording/rig.yaml" \
    --output="$result" --overwrite
  "$build/apps/trajlo_evaluate" "$result/trajectory.tum" "$recording/truth.tum" --names=trajlo \
    --output="$runs/evaluation" --overwrite
  "$root/scripts/draw_run.py" "$result" --evaluation "$runs/evaluation" \
    --title "$scenario (simulated)"
fi
echo
echo "Trajectory, map and statistics are in $result"
page="$result/run.html"
echo "Pictures and tables: $page"
# Shown at once where there is a screen.
if [[ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ]] && command -v xdg-open > /dev/null; then
  xdg-open "$page" > /dev/null 2>&1 &
fi
