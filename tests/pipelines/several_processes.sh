#!/usr/bin/env bash
# Several processes at once in one folder end with one right result.
source "$(dirname "$0")/common.sh"

# together SET...: one process each, at once; their events go to events.N
together() {
    local i=0 set jobs=()
    rm -f events.*
    for set in "$@"; do
        options "$set"
        "$program" bake "${options[@]}" -o out --json >"events.$i" &
        jobs+=($!)
        i=$((i + 1))
    done
    for job in "${jobs[@]}"; do
        wait "$job" || fail "one of $* ends with $?"
    done
}

for round in {1..8}; do
    for sets in "a a" "a a a a"; do
        rm -rf out
        # shellcheck disable=SC2086
        together $sets
        holds out a || fail "$sets: $(sums out)"
        # One has made all, the others have found it.
        makers=$(grep -h '"event":"done"' events.* | grep -vc '"made":0' || true)
        ((makers == 1)) || fail "$sets: $makers processes have baked"
    done
    for sets in "a b" "b a" "a b a b"; do
        # shellcheck disable=SC2086
        together $sets
        holds out a || holds out b || fail "$sets: a mixture: $(sums out)"
        "$program" verify out >/dev/null || fail "$sets: verify"
    done
done
echo "40 rounds of 2 and 4 processes"
