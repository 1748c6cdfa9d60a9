#!/usr/bin/env bash
# From a fresh Debian 12 to the first tables: installs packages, builds, bakes examples/earth.toml.
#   examples/quickstart.sh              does all of it
#   examples/quickstart.sh --configure  stops before the build
set -euo pipefail
cd "$(dirname "$0")/.."
folder=build/quickstart

# Runs the build and shows how far it is: one line that is rewritten in a terminal, one line for each
# tenth of the build elsewhere. The whole output appears if the build fails.
build() {
    local log=$folder/build.log shown=-1 line percent
    set +e
    cmake --build $folder 2>&1 | tee "$log" | while IFS= read -r line; do
        [[ $line =~ ^\[([0-9]+)/([0-9]+)\] ]] || continue
        percent=$((100 * BASH_REMATCH[1] / BASH_REMATCH[2]))
        if [[ -t 2 ]]; then
            printf '\rbuilding skybake: %3d %%, %d s' "$percent" "$SECONDS" >&2
        elif ((percent / 10 > shown)); then
            shown=$((percent / 10))
            echo "building skybake: $percent %, $SECONDS s" >&2
        fi
    done
    local status=${PIPESTATUS[0]}
    set -e
    [[ -t 2 ]] && echo >&2
    ((status == 0)) || cat "$log" >&2
    return "$status"
}

examples/install_packages.sh
cmake --preset quickstart >/dev/null
[[ "${1:-}" != --configure ]] || exit 0
echo "building skybake, which takes about four minutes on two cores" >&2
SECONDS=0
build
$folder/cli/skybake bake examples/earth.toml -o out
$folder/cli/skybake verify out
