#!/usr/bin/env bash
# The example with the installed package: each change bakes, and packs, just what depends on it.
#   cmake_package.sh CMAKE GENERATOR EXAMPLE PREFIX WORK_FOLDER
set -euo pipefail
cmake=$1 generator=$2 example=$3 prefix=$4 work=$5
program=make
[[ $generator == *Make* ]] || program=ninja
command -v "$program" >/dev/null || { echo "skipped: no $program"; exit 77; }
rm -rf "$work"
cp -r "$example" "$work"
cd "$work"
# A program of its own, to touch.
cp -r "$prefix" prefix
unset SKYBAKE_CACHE_DIR

fail() {
    echo "FAILED: $*" >&2
    cat log >&2
    exit 1
}

build() { "$cmake" --build "build tree" -j2 >log 2>&1; }
bakes() { grep -c 'Baking sky' log || true; }
packed() { sed -n 's/.*Packing //p' log | sort | tr '\n' ' '; }

# state NAME: time stamp and bytes of a baked file and of what is made of it
state() {
    local file
    for file in "build tree/sky/$1" "build tree/$1.tar.gz"; do
        stat -c '%y %n' "$file"
        md5sum "$file"
    done
}

# expect WHAT BAKES PACKS...: a build bakes so often and packs these; another build does nothing
expect() {
    local what=$1 baking=$2 name
    shift 2
    declare -A before
    for name in "${assets[@]}"; do before[$name]=$(state "$name" 2>/dev/null || true); done
    build || fail "$what: the build fails"
    (($(bakes) == baking)) || fail "$what: skybake ran $(bakes) times, not $baking"
    [[ "$(packed)" == "$(printf '%s\n' "$@" | sort | tr '\n' ' ' | sed 's/^ $//')" ]] ||
        fail "$what: packed $(packed), not $*"
    for name in "${assets[@]}"; do
        [[ " $* " == *" $name "* || "${before[$name]}" == "$(state "$name")" ]] ||
            fail "$what: $name was touched"
    done
    build || fail "$what: the build after it fails"
    (($(bakes) == 0)) && [[ -z "$(packed)" ]] || fail "$what: the build after it does something"
    echo "$what: bakes $baking, packs $*"
}

# refuse WHAT TEXT: a build fails and says so
refuse() {
    ! build || fail "$1: the build succeeds"
    tr -s ' \n' ' ' <log | grep -qF -- "$2" || fail "$1: no word of $2"
    echo "$1: refused"
}

assets=(transmittance.exr multiple_scattering.exr wisps.vdb)
"$cmake" -S . -B "build tree" -G "$generator" -DCMAKE_PREFIX_PATH="$PWD/prefix" >log || fail "configure"
expect "first build" 1 "${assets[@]}"
first=$(state multiple_scattering.exr | md5sum)
expect "nothing" 0

sed -i 's/ground_albedo = 0.3/ground_albedo = 0.1/' weather.toml
expect "albedo in the included file" 1 multiple_scattering.exr
[[ "$first" != "$(state multiple_scattering.exr | md5sum)" ]] || fail "the table is the old one"
sed -i 's/seed = 1/seed = 2/' weather.toml
expect "seed in the included file" 1 wisps.vdb
echo '# a fair day' >>weather.toml
expect "a comment" 1
touch sky.toml
expect "a touched recipe" 1
touch prefix/bin/skybake
expect "a touched program" 1
rm "build tree/sky/wisps.vdb"
expect "a removed asset" 1 wisps.vdb
rm "build tree/transmittance.exr.tar.gz"
expect "a removed pack" 0 transmittance.exr
sed -i 's/^    RECIPE sky.toml/&\n    SET noise.wisps.seed=7/' CMakeLists.txt
expect "SET" 1 wisps.vdb
sed -i 's/seed=7/seed=8/' CMakeLists.txt
expect "another SET" 1 wisps.vdb

# A mistake is told, and corrected, it is forgotten.
sed -i 's/ground_albedo/ground_albeddo/' weather.toml
refuse "a mistake in the recipe" 'did you mean `ground_albedo`?'
sed -i 's/ground_albeddo/ground_albedo/' weather.toml
expect "the mistake corrected" 1
mv weather.toml elsewhere.toml
refuse "a missing include" 'weather.toml`: No such file'
mv elsewhere.toml weather.toml
expect "the include is back, as it was" 0
sed -i 's/^    OUTPUTS/& clouds.vdb/' CMakeLists.txt
refuse "an output that nothing makes" 'OUTPUTS names a file that the recipe does not bake'
refuse "still" 'clouds.vdb'
sed -i 's/OUTPUTS clouds.vdb/OUTPUTS/' CMakeLists.txt
build || fail "the output corrected: the build fails"
expect "the output corrected" 0
