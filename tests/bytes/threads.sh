#!/usr/bin/env bash
# 1 thread and 7, which no machine has, beside as many as this one has.
source "$(dirname "$0")/common.sh"
for threads in 1 7; do
    on_threads() { "$program" "$@" -j "$threads"; }
    bake "$work/threads-$threads" on_threads
    same "$reference" "$work/threads-$threads"
done
