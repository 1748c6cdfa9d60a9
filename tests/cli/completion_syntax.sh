#!/usr/bin/env bash
# A shell reads its completion script without complaint.
#   completion_syntax.sh SKYBAKE SHELL
set -euo pipefail
skybake=$1 shell=$2
command -v "$shell" >/dev/null || { echo "skipped: no $shell"; exit 77; }
script=$(mktemp)
trap 'rm -f "$script"' EXIT
"$skybake" help --completion "$shell" >"$script"
"$shell" -n "$script"
