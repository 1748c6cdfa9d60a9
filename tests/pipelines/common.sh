# Shared by the tests of robustness: a small recipe with two sets of values, and what is right.
#   NAME.sh SKYBAKE WORK_FOLDER
set -euo pipefail
program=$1
work=$2
rm -rf "$work"
mkdir -p "$work"
cd "$work"

fail() {
    echo "FAILED: $*" >&2
    exit 1
}

# Tables, volumes, a cloud and its grid, every format; each depends on what `changes` changes.
cat >sky.toml <<'TOML'
preset = "earth_hillaire"

[bake.transmittance]
size = [32, 8]

[bake.depth]
asset = "transmittance"
content = "optical_depth"
size = [24, 6]

[noise.wisps.channels.Y]
type = "perlin"
frequency = 3

[bake.wisps]
asset = "noise_volume"
noise = "wisps"
size = [16, 16, 16]
formats = ["exr", "vdb", "bin"]

[clouds.puff]
noise = "wisps"
extent = ["1 km", "1 km", "500 m"]
base_altitude = "1 km"

[bake.puff]
asset = "cloud_volume"
cloud = "puff"
size = [16, 16, 16]

[bake.puff_grid]
asset = "occupancy"
of = "puff"
TOML
changes=(--set 'atmosphere.layers.rayleigh.scale_height="7 km"' --set noise.wisps.seed=2)

# options SET: of set a, the recipe as it is, or b, with the changes
options() {
    options=(sky.toml --certify off --quiet)
    [[ $1 == a ]] || options+=("${changes[@]}")
}

# bake SET FOLDER [OPTION...]
bake() {
    options "$1"
    "$program" bake "${options[@]}" -o "$2" "${@:3}" >/dev/null
}

# sums FOLDER: a line for each file, times and the hashes over them aside
sums() {
    (
        cd "$1"
        shopt -s dotglob nullglob
        files=()
        for file in *; do [[ -d $file ]] || files+=("$file"); done
        ((${#files[@]})) || exit 0
        md5sum -- "${files[@]}" | sed '/ manifest.json$/d; s/^.* timing.csv$/timing.csv/'
        [[ ! -e manifest.json ]] ||
            sed -E 's/"([a-z]+_s|threads|hash)": [^,]*/"\1"/' manifest.json | md5sum | sed 's/-/manifest.json/'
    )
}

# holds FOLDER SET: that and nothing else
holds() { [[ "$(sums "$1")" == "${clean[$2]}" ]]; }

# none_is_partial FOLDER: each file is one of the clean ones, or a hidden temporary
none_is_partial() {
    local line
    while read -r line; do
        [[ $line =~ [[:space:]]\..*\.skybake-[0-9]+-[0-9]+\.tmp$ ]] && continue
        grep -qxF -- "$line" <<<"${clean[a]}"$'\n'"${clean[b]}" || fail "partial file: $line"
    done < <(sums "$1")
}

# other SET
other() { [[ $1 == a ]] && echo b || echo a; }

declare -A clean
for set in a b; do
    bake "$set" "clean_$set"
    clean[$set]=$(sums "clean_$set")
done
[[ ${#clean[a]} -gt 0 && "${clean[a]}" != "${clean[b]}" ]] || fail "the sets do not differ"

# timed COMMAND...: sets bake_ms, for random moments, which change with what else the machine does
timed() {
    local started
    started=$(date +%s%N)
    "$@"
    bake_ms=$((($(date +%s%N) - started) / 1000000 + 1))
}
timed bake a clean_again
holds clean_again a || fail "two clean bakes differ"
RANDOM=20241

# random_moment MILLISECONDS: up to that, in seconds
random_moment() {
    local us=$((((RANDOM << 15) | RANDOM) % ($1 * 1000)))
    printf -v moment '%d.%06d' $((us / 1000000)) $((us % 1000000))
}
