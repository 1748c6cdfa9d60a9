#!/usr/bin/env bash
# Each instruction set that this machine has.
source "$(dirname "$0")/common.sh"
for target in $("$BAKE_ON_TARGET" --list); do
    bake "$work/$target" "$BAKE_ON_TARGET" "$target"
    same "$reference" "$work/$target"
done
