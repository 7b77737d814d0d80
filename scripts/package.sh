#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes trajlo_VERSION_amd64.deb (the commands) and libtrajlo-dev_VERSION_amd64.deb (the libraries) in
# packages/ of a build of its own, build-package/, for every CPU of this machine's architecture.
#   scripts/package.sh              then: sudo apt install ./build-package/packages/trajlo_*.deb
# TRAJLO_BUILD_DIR names another build folder, TRAJLO_JOBS bounds the jobs.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
export TRAJLO_BUILD_DIR="${TRAJLO_BUILD_DIR:-$root/build-package}"

if [[ "${1:-}" == "-h" || "${1:-}" == "--help" ]]; then
  sed -n '3,6p' "${BASH_SOURCE[0]}" | sed 's/^# \{0,1\}//'
  exit 0
fi
"$root/scripts/install_dependencies.sh"
cmake -S "$root" -B "$TRAJLO_BUILD_DIR" -G Ninja -DTRAJLO_ARCH= -DTRAJLO_BUILD_TESTS=OFF
"$root/scripts/build.sh"
rm -rf "$TRAJLO_BUILD_DIR/packages"
(cd "$TRAJLO_BUILD_DIR" && cpack -G DEB -B packages)
ls "$TRAJLO_BUILD_DIR"/packages/*.deb
