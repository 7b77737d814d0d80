#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Packs a build as Debian packages, unpacks them into a folder that stands for the root of a machine, and
# works there as a user would, in a folder of one's own: simulate, run, evaluate, draw the page.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
sources="$(cd "$here/../.." && pwd)"
build="$(cd "${TRAJLO_BUILD_DIR:-$sources/build}" && pwd)"
folder="$(mktemp -d -t trajlo_package.XXXXXX)"
trap 'rm -rf "$folder"' EXIT

fail() {
  echo "check.sh: $*" >&2
  exit 1
}

(cd "$build" && cpack -G DEB -B "$folder/packed") >"$folder/log" 2>&1 || fail "$(tail "$folder/log")"
programs=("$folder"/packed/trajlo_*.deb)
libraries=("$folder"/packed/libtrajlo-dev_*.deb)

# What apt is told.
for wanted in "Package trajlo" "Depends libc6" "Depends libyaml-cpp" "Depends python3-matplotlib" \
  "Depends libjs-three" "Architecture $(dpkg --print-architecture)"; do
  read -r field value <<<"$wanted"
  [[ "$(dpkg-deb --field "${programs[0]}" "$field")" == *"$value"* ]] ||
    fail "the package has no $value in its $field"
done

root="$folder/root"
dpkg -x "${programs[0]}" "$root"
dpkg -x "${libraries[0]}" "$root"
for file in usr/bin/trajlo_run usr/bin/trajlo_draw_run usr/share/trajlo/config/default.yaml \
  usr/share/doc/trajlo/copyright \
  usr/include/trajlo/core/odometry/odometry.h; do
  [[ -s "$root/$file" ]] || fail "$file is not in the packages"
done
# Whoever installs it has neither our sources nor our build.
! grep -rlF -e "$sources" -e "$build" "$root" || fail "these name folders of this machine"

mkdir "$folder/work"
cd "$folder/work"
user=(env -i "PATH=$root/usr/bin:/usr/bin:/bin" "HOME=$folder/work" LC_ALL=C.UTF-8)
"${user[@]}" trajlo_simulate --scenario=hall_os1_16 --duration_s=3 --output=recording
"${user[@]}" trajlo_run --input=recording --config=recording/rig.yaml --output=result
"${user[@]}" trajlo_evaluate result/trajectory.tum recording/truth.tum --output=evaluation
"${user[@]}" trajlo_draw_run result --evaluation=evaluation
[[ -s evaluation/report.html ]] || fail "trajlo_evaluate drew no page"
grep -q "THREE" result/run.html || fail "the page has no 3-D view"
! grep -q "There is no 3-D view" result/run.html || fail "the page has no 3-D view"
error_m="$(python3 -c 'import json
print(json.load(open("evaluation/evaluation.json"))["estimates"][0]["ate"]["translation_m"]["rmse"])')"
python3 -c "import sys; sys.exit(not 0 < $error_m < 0.1)" || fail "an error of $error_m m"

completion="$root/usr/share/bash-completion/completions/trajlo_info"
"${user[@]}" bash -c "source '$completion' && complete -p trajlo_info" >/dev/null ||
  fail "bash cannot complete trajlo_info"

# Batches find their suite and the installed programs.
suite="$root/usr/share/trajlo/config/suites/simulation.yaml"
"${user[@]}" trajlo_batch "$suite" --list >list.txt || fail "trajlo_batch: $(tail -n 5 list.txt)"
grep -q "hall_os1_16" list.txt || fail "trajlo_batch lists no run"
echo "check.sh: $error_m m after simulate, run, evaluate and draw from $(basename "${programs[0]}")"
