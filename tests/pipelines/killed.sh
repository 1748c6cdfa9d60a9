#!/usr/bin/env bash
# Killed at random moments of a bake, 50 of them or as many as SKYBAKE_KILLS says, half of them while it
# writes: nothing but whole files under their names, and the next run completes and leaves what a clean
# one leaves.
source "$(dirname "$0")/common.sh"

has_temporaries() { compgen -G 'out/.*.tmp' >/dev/null; }

# kill_any_time: the program's exit code; the next run may begin before it is quite gone
kill_any_time() {
    random_moment "$bake_ms"
    timeout -s KILL "$moment" "$program" bake "${options[@]}" -o out >/dev/null 2>log
}

# kill_while_writing: at a random moment after the first temporary
kill_while_writing() {
    "$program" bake "${options[@]}" -o out >/dev/null 2>log &
    local job=$!
    while kill -0 "$job" && ! has_temporaries; do :; done
    random_moment $((bake_ms / 3 + 1))
    sleep "$moment"
    kill -KILL "$job"
    wait "$job"
} 2>/dev/null

kills=0 while_writing=0 completed=0 set=a most=${SKYBAKE_KILLS:-50}
while ((kills < most || while_writing < most / 10)); do
    # Now and then into a new folder; mostly over what earlier runs have left.
    ((RANDOM % 8)) || rm -rf out
    options "$set"
    code=0
    if ((RANDOM % 2)); then kill_any_time || code=$?; else kill_while_writing || code=$?; fi
    case $code in
        0) ;;
        137) kills=$((kills + 1)) ;;
        *) cat log >&2; fail "exit code $code" ;;
    esac
    if [[ -d out ]]; then
        none_is_partial out
        ! has_temporaries || while_writing=$((while_writing + 1))
    fi
    # Every other killed run is followed by one that is killed, too.
    if ((RANDOM % 2)); then
        ((RANDOM % 2)) || set=$(other "$set")
        timed bake "$set" out || fail "the run after kill $kills fails"
        holds out "$set" || fail "the run after kill $kills: $(diff <(sums out) <(echo "${clean[$set]}"))"
        completed=$((completed + 1))
    fi
    set=$(other "$set")
done 2> >(grep -v Killed >&2)
echo "$kills kills, $while_writing while files were written; $completed runs after them as clean ones"
