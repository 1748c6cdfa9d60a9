#!/usr/bin/env bash
# Drives the pages of a skybake program through Chromium.
#   tests/browser/run.sh build/dev/cli/skybake build/dev/tests/browser
# Ends with 77 where that cannot be done here.
set -euo pipefail
program=$(realpath "$1")
mkdir -p "$2"
folder=$(realpath "$2")
here=$(realpath "$(dirname "$0")")

skip() { echo "skipped: $1"; exit 77; }
[[ -x /usr/bin/chromium ]] || skip "there is no /usr/bin/chromium"
command -v node >/dev/null || skip "there is no node"
command -v npm >/dev/null || skip "there is no npm"

# Once for each version that package-lock.json names.
if ! cmp -s "$here/package-lock.json" "$folder/installed.json"; then
    cp "$here/package.json" "$here/package-lock.json" "$folder"
    (cd "$folder" && npm ci --no-audit --no-fund --loglevel=error --fetch-retries=0 --fetch-timeout=30000) || skip "npm cannot install playwright-core"
    cp "$here/package-lock.json" "$folder/installed.json"
fi
NODE_PATH="$folder/node_modules" exec node "$here/preview_page.js" "$program" "$folder"
