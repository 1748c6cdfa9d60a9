#!/usr/bin/env bash
# Ctrl-C at 80 random moments: exit code 130 (0 where it came too late), the folder as it was or all
# of the new, no temporaries, and no folder that was not there. Twice in a row: no partial file and
# no temporaries.
source "$(dirname "$0")/common.sh"

# interrupt ARGUMENT...: of timeout; sets code
interrupt() {
    random_moment "$bake_ms"
    code=0
    timeout --preserve-status -s INT "$@" "$moment" "$program" bake "${options[@]}" -o out \
        >/dev/null 2>log || code=$?
    ((code == 0 || code == 130)) || fail "exit code $code: $(cat log)"
    ((code == 0)) || interrupts=$((interrupts + 1))
}

interrupts=0 previous=none
for ((round = 0; round < 60; ++round)); do
    if ((RANDOM % 4 == 0)); then
        rm -rf out
        previous=none
    fi
    next=$([[ $previous == a ]] && echo b || echo a)
    options "$next"
    interrupt --foreground
    if [[ -e out ]] && holds out "$next"; then previous=$next; fi
    ((code)) || [[ $previous == "$next" ]] || fail "exit code 0, but: $(sums out)"
    if [[ $previous == none ]]; then
        [[ ! -e out ]] || fail "a folder is left, and in it: $(ls -A out)"
    else
        holds out "$previous" || fail "round $round, exit code $code: $(sums out)"
    fi
done
((interrupts >= 10)) || fail "only $interrupts interrupts came in time"

# Without --foreground the signal goes to the process and to its group: it arrives twice.
timed bake a out
for ((round = 0; round < 20; ++round)); do
    options "$([[ $((round % 2)) == 0 ]] && echo b || echo a)"
    interrupt
    none_is_partial out
    ! compgen -G 'out/.*.tmp' >/dev/null || fail "a temporary is left: $(ls -A out)"
done
echo "$interrupts interrupts at random moments"
