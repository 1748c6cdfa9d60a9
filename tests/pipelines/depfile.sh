#!/usr/bin/env bash
# Ninja and GNU Make read back every name of a dependency file.
source "$(dirname "$0")/common.sh"
command -v ninja >/dev/null || { echo "skipped: no ninja"; exit 77; }
command -v make >/dev/null || { echo "skipped: no make"; exit 77; }

# A coverage map of 1 by 1 texels, as the cheapest image that is read.
printf '%s' 'iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGNoAAAAggCBd81ytgAAAABJRU5ErkJggg==' |
    base64 -d >map.png

# The program's modules, in lib/skybake of a folder above it.
modules=()
for folder in "$(dirname "$(readlink -f "$program")")"/{..,../..}/lib/skybake; do
    for module in skybake_vdb skybake_images; do
        [[ ! -e $folder/$module.so ]] || modules+=("$(readlink -f "$folder/$module.so")")
    done
done
((${#modules[@]} == 2)) || fail "modules: ${modules[*]}"

for name in plain 'with space' 'number#sign' 'dol$lar' 'co:lon' 'back\slash' 'both\ of' '#  $$::x' 'grün'; do
    mkdir "$name"
    cp map.png "$name/$name.png"
    printf '[atmosphere]\nground_albedo = 0.1\n' >"$name/$name.inc"
    cat >"$name/$name.toml" <<TOML
preset = "earth_hillaire"
include = ['$name.inc']
[bake.transmittance]
size = [16, 8]
[noise.wisps.channels.Y]
type = "perlin"
frequency = 3
[clouds.puff]
noise = "wisps"
extent = ["1 km", "1 km", "500 m"]
base_altitude = "1 km"
coverage_map = { file = '$name.png', channel = "Y", color_space = "linear" }
[bake.puff]
asset = "cloud_volume"
cloud = "puff"
size = [16, 16, 16]
TOML
    "$program" bake "$name/$name.toml" -o "$name/out" --certify off -q --depfile rules.d >/dev/null
    inputs=("$name/$name.inc" "$name/$name.png" "$name/$name.toml" "$(readlink -f "$program")" "${modules[@]}")

    # Ninja, with its log of dependencies: exactly these.
    rm -f .ninja_*
    printf 'rule bake\n  command = cp rules.d read.d && touch stamp\n  depfile = read.d\n  deps = gcc\nbuild stamp: bake\n' \
        >build.ninja
    ninja >/dev/null
    diff <(ninja -t deps | sed -n 's/^    //p' | sort) <(printf '%s\n' "${inputs[@]}" | sort) ||
        fail "ninja reads other names for $name"

    # Make: whichever file changes, the rule runs, and only then; a file that is gone stops nothing.
    printf 'all:\ninclude rules.d\n' >makefile
    target=$(sed -n '1s/: \\$//p' rules.d)
    printf 'all: %s\n%s &:\n\t@echo bakes\n' "$target" "$target" >>makefile
    touch -d '2020-01-01' "$name"/*.*
    [[ $(make -s) == "" ]] || fail "make finds something to do for $name: $(make -s)"
    for input in "${inputs[@]:0:3}"; do
        touch -d '2099-01-01' "$input"
        [[ $(make -s 2>/dev/null) == bakes ]] || fail "make does not see a change of $input"
        touch -d '2020-01-01' "$input"
    done
    rm "$name/$name.inc"
    [[ $(make -s) == bakes ]] || fail "make stops where an include of $name is gone"
done
echo "9 spellings"
