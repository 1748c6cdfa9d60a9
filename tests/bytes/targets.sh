#!/usr/bin/env bash
# Each instruction set that this machine has but the best one, which made the reference.
source "$(dirname "$0")/common.sh"
for target in $("$BAKE_ON_TARGET" --list | tail -n +2); do
    bake "$work/$target" "$BAKE_ON_TARGET" "$target"
    same "$reference" "$work/$target"
done
