#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# From a fresh Debian 12 machine to a trajectory, a map and a picture of them, in one command:
# installs what is missing, builds, simulates a recording, and runs the odometry on it.
#   scripts/quickstart.sh [RECORDING]     with a folder of scans, that is used in place of a
#                                         simulated one
# Results are in runs/quickstart (TRAJLO_RUNS names another folder for runs/).
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
build="${TRAJLO_BUILD_DIR:-$root/build}"
runs="${TRAJLO_RUNS:-$root/runs}/quickstart"
scenario="hall_os1_16"

if [[ "${1:-}" == "-h" || "${1:-}" == "--help" ]]; then
  sed -n '3,7p' "${BASH_SOURCE[0]}" | sed 's/^# \{0,1\}//'
  exit 0
fi

"$root/scripts/install_dependencies.sh"
"$root/scripts/build.sh" --target trajlo_run trajlo_simulate

mkdir -p "$runs"
plot_arguments=()
run_arguments=()
if [[ $# -ge 1 ]]; then
  recording="$1"
else
  recording="$runs/recording"
  "$build/apps/trajlo_simulate" --scenario="$scenario" --duration_s=15 --output="$recording" \
    --overwrite
  run_arguments+=(--config="$root/config/datasets/$scenario.yaml")
  plot_arguments+=(--truth "$recording/truth.tum" --title "$scenario (simulated)")
fi
"$build/apps/trajlo_run" --input="$recording" --output="$runs/result" --overwrite \
  "${run_arguments[@]}"
/usr/bin/python3 "$root/scripts/plot_run.py" "$runs/result" "${plot_arguments[@]}" \
  --output "$runs/result/picture.png"
echo
echo "Trajectory, map, statistics and picture are in $runs/result"
