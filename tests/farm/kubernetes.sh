#!/usr/bin/env bash
# Holds the job that examples/farm/kubernetes.py prints to the schema that Kubernetes publishes, and sees three
# spoilt jobs refused.
#   kubernetes.sh PROGRAM FOLDER
set -euo pipefail
program=$1
folder=$2
here=$(cd "$(dirname "$0")" && pwd)
skip() { echo "skipped: $1"; exit 77; }
command -v node >/dev/null || skip "there is no node"
command -v npm >/dev/null || skip "there is no npm"
mkdir -p "$folder"
if ! cmp -s "$here/package-lock.json" "$folder/installed.json"; then
    cp "$here/package.json" "$here/package-lock.json" "$folder"
    (cd "$folder" && npm ci --no-audit --no-fund --loglevel=error --fetch-retries=0 --fetch-timeout=30000) ||
        skip "npm cannot install the packages"
    cp "$here/package-lock.json" "$folder/installed.json"
fi
"$program" sweep "$here/../../examples/earth.toml" --vary atmosphere.ground_albedo=0.1,0.2 \
    -o "$folder/sweep" --emit commands -j 3 -q >"$folder/tasks"
python3 "$here/../../examples/farm/kubernetes.py" registry/skybake "$folder/tasks" >"$folder/job.json"
cp "$here/kubernetes_job.mjs" "$folder"  # beside the packages that it imports
exec node "$folder/kubernetes_job.mjs" "$folder/job.json"
