#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what is missing of scripts/packages.txt, as root or with sudo. Does nothing, and needs
# neither network nor rights, when everything is there. With --checks also packages_checks.txt.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"

lists=("$here/packages.txt")
case "${1:-}" in
  "") ;;
  -h | --help)
    sed -n '3,4p' "${BASH_SOURCE[0]}" | sed 's/^# \{0,1\}//'
    exit 0
    ;;
  --checks) lists+=("$here/packages_checks.txt") ;;
  *) echo "install_dependencies.sh: $1 is no option; --checks is the only one" >&2; exit 1 ;;
esac

if ! command -v apt-get >/dev/null; then
  echo "install_dependencies.sh: this script is for Debian 12 (apt-get was not found);" \
       "install what scripts/packages.txt lists in your system's way" >&2
  exit 1
fi

mapfile -t packages < <(grep -hEv '^[[:space:]]*(#|$)' "${lists[@]}")
missing=()
for package in "${packages[@]}"; do
  status="$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)"
  [[ "$status" == installed ]] || missing+=("$package")
done
if [[ ${#missing[@]} -eq 0 ]]; then
  echo "All ${#packages[@]} packages are installed."
  exit 0
fi

as_root=()
if [[ "$(id -u)" -ne 0 ]]; then
  if ! command -v sudo >/dev/null; then
    echo "install_dependencies.sh: run this as root, or install sudo; missing: ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
echo "Installing ${missing[*]}"
export DEBIAN_FRONTEND=noninteractive
"${as_root[@]}" apt-get update -q
# env, as sudo does not hand the variable on.
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install -q -y --no-install-recommends "${missing[@]}"
