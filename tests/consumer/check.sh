#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs the libraries of a build into a temporary folder and builds a user's project against them:
# each component is found with what it stands on; our own flags stay with us; and programs that set up
# Eigen in other ways either compute the same or do not compile.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
build="${TRAJLO_BUILD_DIR:-$here/../../build}"
folder="$(mktemp -d -t trajlo_consumer.XXXXXX)"
trap 'rm -rf "$folder"' EXIT

fail() {
  echo "check.sh: $*" >&2
  exit 1
}

cmake --install "$build" --prefix "$folder/prefix" --component development >"$folder/log" ||
  fail "the libraries cannot be installed: $(tail -n 5 "$folder/log")"
# Moved, so that nothing can depend on where it was.
mv "$folder/prefix" "$folder/moved"
! grep -rnF --include=*.cmake -e "$(cd "$build" && pwd)" -e "$(cd "$here/../.." && pwd)" "$folder/moved" ||
  fail "the package names the folder that it was built in"

# configure NAME SOURCES [CMAKE ARGUMENTS...]
configure() {
  cmake -S "$2" -B "$folder/$1" -DCMAKE_PREFIX_PATH="$folder/moved" -DCMAKE_EXPORT_COMPILE_COMMANDS=ON \
    -DCMAKE_BUILD_TYPE=Release "${@:3}" >"$folder/$1.log" 2>&1
}

# Every component alone, linked to a program: CMake fails where something is missing.
configure_with() {
  mkdir "$folder/$1.project"
  cat >"$folder/$1.project/CMakeLists.txt" <<PROJECT
cmake_minimum_required(VERSION 3.22)
project(one LANGUAGES C CXX)
find_package(trajlo REQUIRED COMPONENTS $1)
file(WRITE main.cc "int main() {}")
add_executable(one main.cc)
target_link_libraries(one PRIVATE trajlo::$1)
PROJECT
  configure "$1" "$folder/$1.project"
}
components="$(sed -n 's/^set(trajlo_components \(.*\))/\1/p' "$(find "$folder/moved" -name trajlo-config.cmake)")"
for component in ${components//;/ }; do
  configure_with "$component" || fail "trajlo::$component alone: $(cat "$folder/$component.log")"
done
! configure_with nonsense || fail "a component that is not there was found"
grep -q "no component 'nonsense'" "$folder/nonsense.log" || fail "unclear: $(cat "$folder/nonsense.log")"

# Nothing but paths and what Eigen's users agree on reaches the user's compiler.
configure default "$here" || fail "$(cat "$folder/default.log")"
! grep -E -e '-Werror|-march|-Wall|EIGEN_' "$folder/default/compile_commands.json" ||
  fail "flags of ours reach the user"

# Headers that use Eigen check how it is set up.
cd "$folder/moved/include/trajlo"
python3 "$here/unchecked_headers.py" || fail "these headers use Eigen without manifolds/eigen_abi.h"
cd "$folder"

compile="$(sed -n 's/^ *"command": "\(.*\) -o .*/\1/p' "$folder/default/compile_commands.json")"
for flags in -mavx2 -march=skylake-avx512 -DEIGEN_DONT_VECTORIZE -DEIGEN_DONT_ALIGN -fsanitize=address; do
  # shellcheck disable=SC2086
  ! $compile -fsyntax-only $flags "$here/main.cc" 2>"$folder/log" || fail "compiles with $flags"
  grep -q "otherwise than in the trajlo libraries" "$folder/log" ||
    fail "$flags: unclear: $(cat "$folder/log")"
done

# The library does the computing, so all of these must print the same.
run() {
  configure "$1" "$here" "${@:2}" || fail "$(cat "$folder/$1.log")"
  cmake --build "$folder/$1" >>"$folder/$1.log" 2>&1 || fail "$(cat "$folder/$1.log")"
  "$folder/$1/consumer" >"$folder/$1.txt" || fail "$* is wrong or crashed: $(cat "$folder/$1.txt")"
  echo "$1: $(cat "$folder/$1.txt")"
  cmp "$folder/default.txt" "$folder/$1.txt" || fail "$* computes something else"
}
agreed="-DEIGEN_DONT_VECTORIZE -DEIGEN_MAX_STATIC_ALIGN_BYTES=16"
run default
run debug -DCMAKE_BUILD_TYPE=Debug
run native -DCMAKE_CXX_FLAGS="-march=native $agreed"
run sanitized -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS="-march=native -fsanitize=address $agreed"
