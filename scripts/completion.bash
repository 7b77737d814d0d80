# SPDX-License-Identifier: MIT
# shellcheck shell=bash disable=SC1090
# Bash reads this where one of the commands is installed and is completed for the first time.
source <(trajlo_run --completion=bash 2>/dev/null)
