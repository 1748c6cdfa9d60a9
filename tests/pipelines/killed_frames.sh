#!/usr/bin/env bash
# Killed when files get their names, at each of them in turn: the manifest is named last, the next run
# takes what is complete, makes the rest and ends as a clean one. `strace` sends the signals.
#   exit code 77, skipped, where strace is not installed
command -v strace >/dev/null || { echo "skipped: there is no strace"; exit 77; }
source "$(dirname "$0")/common.sh"
strace -qq -o /dev/null true 2>log || { echo "skipped: strace may not trace: $(cat log)"; exit 77; }

cat >frames.toml <<'TOML'
[noise.n]
period = 6
drift = [1, 0, 0]
[noise.n.channels.Y]
type = "worley"
frequency = 2
[bake.n]
asset = "noise_volume"
noise = "n"
size = [8, 8, 8]
frames = 6
formats = ["bin", "npy"]
[bake.still]
asset = "noise_volume"
noise = "n"
size = [8, 8, 8]
formats = ["bin"]
TOML

# renames LOG: the names that files got, in order
renames() { sed -nE 's/.*rename\("[^"]*", "[^"]*\/([^"]*)"\) = 0/\1/p' "$1"; }

# traced FOLDER OPTION...: a bake under strace with these options; its calls are in `trace`
traced() {
    local folder=$1
    shift
    strace -f -o trace -e trace=rename "$@" "$program" bake frames.toml --certify off -j 1 -o "$folder" >/dev/null 2>log
}

traced clean || fail "$(cat log)"
mapfile -t named < <(renames trace)
[[ ${#named[@]} == 14 && ${named[13]} == manifest.json ]] || fail "named in this order: ${named[*]}"
[[ ${named[0]} == n_0001.* && ${named[11]} == n_0006.* ]] || fail "frames are not named in order: ${named[*]}"

# made FOLDER: the assets that a bake had to make, and whose manifest is checked
made() {
    "$program" bake frames.toml --certify off -o "$1" --json >events 2>log || fail "the next run: $(cat log)"
    [[ "$(sums "$1")" == "$(sums clean)" ]] || fail "$1: $(diff <(sums "$1") <(sums clean))"
    "$program" verify "$1" >/dev/null || fail "$1: verify"
    made=$(sed -nE 's/.*"event":"done".*"made":([0-9]+).*/\1/p' events)
}

for at in {1..14}; do
    code=0
    traced "killed$at" -e inject=rename:signal=KILL:when="$at" || code=$?
    ((code == 137)) || fail "not killed at name $at: exit code $code"
    complete=$(((at - 1) / 2 < 6 ? (at - 1) / 2 : 6))
    made "killed$at" || fail "killed at name $at"
    # A frame is complete with its second file. The kill comes before the call or after it.
    ((made == 7 - complete || made == 7 - complete - 1)) || fail "killed at name $at: $made assets made, $complete were complete"
done 2> >(grep -v Killed >&2)
echo "killed at each of 14 names"

# Killed twice, and with another recipe in between: what the first kill left is still known.
traced twice -e inject=rename:signal=KILL:when=6 || true
traced twice -e inject=rename:signal=KILL:when=3 || true
made twice
traced other -e inject=rename:signal=KILL:when=6 || true
sed -i '/^frames/d; s/^\[bake.n\]/[bake.alone]/' frames.toml
"$program" bake frames.toml --certify off -o other --prune >/dev/null 2>log || fail "another recipe: $(cat log)"
[[ -z $(find other -name 'n_*' -o -name '.*.tmp') ]] || fail "what was named before the kill stays: $(ls -A other)"
echo "killed twice, and before another recipe"
