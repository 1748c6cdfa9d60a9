#!/usr/bin/env bash
# Drives a skybake program through Chromium by a script of this folder.
#   tests/browser/run.sh preview_page.js build/quickstart/cli/skybake build/quickstart/tests/browser [ARGUMENTS]
# Ends with 77 where that cannot be done here.
set -euo pipefail
script=$1
program=$(realpath "$2")
mkdir -p "$3"
folder=$(realpath "$3")
here=$(realpath "$(dirname "$0")")
packages=${SKYBAKE_PACKAGES:-$here}  # the folder whose package-lock.json is installed

skip() { echo "skipped: $1"; exit 77; }
[[ -x /usr/bin/chromium ]] || skip "there is no /usr/bin/chromium"
command -v node >/dev/null || skip "there is no node"
command -v npm >/dev/null || skip "there is no npm"

# Once for each version that package-lock.json names. What three-atmosphere's parts for React would
# have besides is left out (--legacy-peer-deps).
if ! cmp -s "$packages/package-lock.json" "$folder/installed.json"; then
    cp "$packages/package.json" "$packages/package-lock.json" "$folder"
    (cd "$folder" && npm ci --legacy-peer-deps --no-audit --no-fund --loglevel=error --fetch-retries=0 --fetch-timeout=${SKYBAKE_FETCH_TIMEOUT:-30000}) ||
        skip "npm cannot install the packages"
    cp "$packages/package-lock.json" "$folder/installed.json"
fi
NODE_PATH="$folder/node_modules" exec node "$here/$script" "$program" "$folder" "${@:4}"
