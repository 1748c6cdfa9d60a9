#!/usr/bin/env bash
# groff reads every man page without a warning, and its text holds the command and its options.
#   man_pages.sh SKYBAKE
set -euo pipefail
skybake=$1
command -v groff >/dev/null || { echo "skipped: no groff"; exit 77; }
failures=0

# read_page NAME WORDS...: the page that `skybake help WORDS... --man` prints
read_page() {
    local name=$1 text warnings
    shift
    warnings=$("$skybake" help "$@" --man | groff -man -ww -Tutf8 -P-c 2>&1 >/dev/null)
    text=$("$skybake" help "$@" --man | groff -man -Tutf8 -P-c -P-b -P-u 2>/dev/null)
    [[ -z "$warnings" && "$text" == *"NAME"*"$name"*"SYNOPSIS"*"EXAMPLES"* ]] || {
        echo "$name: $warnings"
        echo "$text"
        failures=$((failures + 1))
    }
    "$skybake" help "$@" --man | cmp - <("$skybake" help "$@" --man)
}

read_page skybake
names=$("$skybake" help | sed -n '/^commands:/,/^$/ s/^  \([a-z]*\) .*/\1/p')
[[ $(wc -w <<<"$names") -ge 14 ]]
for name in $names; do read_page "skybake-$name" "$name" || true; done
exit "$failures"
