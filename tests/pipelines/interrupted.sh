#!/usr/bin/env bash
# Ctrl-C at 60 random moments: exit code 130 and the folder as it was, or 0 and all of the new; no
# temporaries, and no folder that was not there.
source "$(dirname "$0")/common.sh"

interrupts=0 previous=none
for ((round = 0; round < 60; ++round)); do
    if ((RANDOM % 4 == 0)); then
        rm -rf out
        previous=none
    fi
    next=$([[ $previous == a ]] && echo b || echo a)
    options "$next"
    random_moment "$bake_ms"
    code=0
    timeout --preserve-status -s INT "$moment" "$program" bake "${options[@]}" -o out >/dev/null 2>log || code=$?
    case $code in
        0) previous=$next ;;
        130) interrupts=$((interrupts + 1)) ;;
        *) cat log >&2; fail "exit code $code" ;;
    esac
    if [[ $previous == none ]]; then
        [[ ! -e out ]] || fail "a folder is left: $(ls -A out)"
    else
        holds out "$previous" || fail "round $round, exit code $code: $(sums out)"
    fi
done
((interrupts >= 10)) || fail "only $interrupts interrupts came in time"
echo "$interrupts interrupts at random moments"
