#!/usr/bin/env bash
# The bash completion is tried as a shell tries it.
#   completion_bash.sh SKYBAKE
set -euo pipefail
skybake=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
touch earth.toml
mkdir "a folder"
"$skybake" help --completion bash >script
"$skybake" help --completion bash | cmp - script
bash -n script
source ./script
[[ $(complete -p skybake) == "complete -F _skybake skybake" ]]

# expect "REPLIES" WORDS...: what TAB at the end of the last word offers
expect() {
    local wanted=$1
    shift
    COMP_WORDS=(skybake "$@") COMP_CWORD=$#
    COMPREPLY=()
    _skybake || true  # a list without matches
    [[ "${COMPREPLY[*]-}" == "$wanted" ]] || {
        echo "skybake $*: offers '${COMPREPLY[*]-}', not '$wanted'" >&2
        exit 1
    }
}

expect "bake" ba
expect "show schema sweep" s
expect "--color --certify --cache-dir --cache" bake --c
expect "--set" show earth.toml --set
expect "quick full off" bake earth.toml --certify ""
expect "full" bake --certify = fu
expect "quick full off" sweep --certify =
expect "commands" sweep --emit c
expect "auto always" --color a
expect "atmosphere.ground_radius= atmosphere.ground_albedo=" bake earth.toml --set atmosphere.ground_
expect "bake.transmittance.size=" show earth.toml --set bake.transmittance.si
expect "mars mars_rgb" init --preset mar
expect "clouds.thesis" init --preset clouds.th
expect "" bake --jobs ""
expect "a folder" bake -o a
expect "a folder" bake --output a
expect "earth.toml" bake e
expect "earth.toml" check --set x=1 earth
expect "gc" cache g
expect "recipe" schema r
expect "verify" help v
expect "bash" help --completion b
