#!/usr/bin/env bash
# TinyUSDZ, a reader of USD without code of Pixar's, reads the scene of a sequence: time code n shows our file of frame n;
# and scenes that are spoilt are refused.
#   tinyusdz.sh PROGRAM FOLDER     exit code 77, skipped, where Node or the registry of its packages is not there
set -euo pipefail
program=$(realpath "$1")
folder=$2
here=$(cd "$(dirname "$0")" && pwd)
skip() { echo "skipped: $1"; exit 77; }
command -v node >/dev/null || skip "there is no node"
command -v npm >/dev/null || skip "there is no npm"
mkdir -p "$folder"
if ! cmp -s "$here/tinyusdz/package-lock.json" "$folder/installed.json"; then
    cp "$here/tinyusdz/package.json" "$here/tinyusdz/package-lock.json" "$folder"
    (cd "$folder" && npm ci --no-audit --no-fund --loglevel=error --fetch-retries=0 --fetch-timeout=30000) ||
        skip "npm cannot install the packages"
    cp "$here/tinyusdz/package-lock.json" "$folder/installed.json"
fi
"$program" bake "$here/sequence.toml" -o "$folder/baked" -q >/dev/null
cp "$here/tinyusdz/read_scene.mjs" "$folder"  # beside the packages that it imports
exec node "$folder/read_scene.mjs" "$folder/baked"
