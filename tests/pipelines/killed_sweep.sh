#!/usr/bin/env bash
# Killed at random moments of a sweep, 20 of them or as many as SKYBAKE_KILLS says, half of them while it
# writes: the next run completes and leaves what a clean one leaves, the index included.
source "$(dirname "$0")/common.sh"

vary=(--vary noise.wisps.channels.Y.frequency=2,3 --vary clouds.puff.coverage=0.6,0.9)

# sweep SET FOLDER
sweep() {
    options "$1"
    "$program" sweep "${options[@]}" "${vary[@]}" -o "$2" >/dev/null
}

# tree FOLDER: its files, times in manifests aside
tree() {
    local folder
    sums "$1"
    for folder in "$1"/*/; do
        echo "${folder#"$1"}"
        sums "$folder"
    done
}

has_temporaries() { [[ -n $(find out -name '.*.tmp' -print -quit 2>/dev/null) ]]; }

kill_any_time() {
    random_moment "$bake_ms"
    timeout -s KILL "$moment" "$program" sweep "${options[@]}" "${vary[@]}" -o out >/dev/null 2>log
}

kill_while_writing() {
    "$program" sweep "${options[@]}" "${vary[@]}" -o out >/dev/null 2>log &
    local job=$!
    while kill -0 "$job" && ! has_temporaries; do :; done
    random_moment $((bake_ms / 2 + 1))
    sleep "$moment"
    kill -KILL "$job"
    wait "$job"
} 2>/dev/null

declare -A clean_sweep
for set in a b; do
    timed sweep "$set" "clean_sweep_$set"
    clean_sweep[$set]=$(tree "clean_sweep_$set")
done

kills=0 while_writing=0 set=a most=${SKYBAKE_KILLS:-20}
while ((kills < most || while_writing < most / 10)); do
    ((RANDOM % 8)) || rm -rf out
    options "$set"
    code=0
    if ((RANDOM % 2)); then kill_any_time || code=$?; else kill_while_writing || code=$?; fi
    case $code in
        0) ;;
        137) kills=$((kills + 1)) ;;
        *) cat log >&2; fail "exit code $code" ;;
    esac
    ! has_temporaries || while_writing=$((while_writing + 1))
    if ((RANDOM % 2)); then
        ((RANDOM % 2)) || set=$(other "$set")
        timed sweep "$set" out || fail "the run after kill $kills fails"
        [[ "$(tree out)" == "${clean_sweep[$set]}" ]] ||
            fail "the run after kill $kills: $(diff <(tree out) <(echo "${clean_sweep[$set]}"))"
    fi
    set=$(other "$set")
done 2> >(grep -v Killed >&2)
echo "$kills kills of a sweep, $while_writing while files were written"
