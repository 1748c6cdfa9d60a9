#!/usr/bin/env bash
# 1, 2 and 7 threads.
source "$(dirname "$0")/common.sh"
bake "$work/1" "$program"
for threads in 1 2 7; do
    on_threads() { "$program" "$@" -j "$threads"; }
    bake "$work/threads-$threads" on_threads
    same "$work/1" "$work/threads-$threads"
done
