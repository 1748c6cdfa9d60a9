#!/usr/bin/env bash
# Ctrl-C at 60 random moments: exit code 130 (0 where it came too late), the folder as it was or all
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
    # Moments follow what else the machine does: earlier where one came too late, else later.
    if ((code == 0)); then
        bake_ms=$((bake_ms * 9 / 10 + 1))
    else
        bake_ms=$((bake_ms * 21 / 20 + 1)) interrupts=$((interrupts + 1))
    fi
}

interrupts=0 previous=none
while ((interrupts < 40)); do
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
        holds out "$previous" || fail "interrupt $interrupts, exit code $code: $(sums out)"
    fi
done

# Without --foreground the signal goes to the process and to its group: it arrives twice.
bake a out
next=a
while ((interrupts < 60)); do
    next=$(other "$next")
    options "$next"
    interrupt
    none_is_partial out
    ! compgen -G 'out/.*.tmp' >/dev/null || fail "a temporary is left: $(ls -A out)"
done
echo "$interrupts interrupts at random moments"
