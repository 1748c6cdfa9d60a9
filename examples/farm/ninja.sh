#!/bin/sh
# Prints a build.ninja that runs the tasks of a sweep, and after them the merge:
#
#   skybake sweep sky.toml -o sweep --emit commands > tasks
#   sh ninja.sh tasks > sweep.ninja && ninja -f sweep.ninja
#
# Every run asks skybake, which leaves alone what is up to date. A task with variants that cannot be baked
# (exit code 4) lets the others go on, and the merge fails in its place.
awk '
    BEGIN { print "rule run\n  command = $command\n  description = $out\n\nbuild always: phony" }
    {
        gsub(/\$/, "$$")
        print "build task" NR ": run always\n  command = " $0 " || [ $$? -eq 4 ]"
        names = names " task" NR
        merge = $0
    }
    END {
        sub(/ -j [0-9]+ --shard [0-9]+\/[0-9]+$/, " --merge", merge)
        print "build index: run always ||" names "\n  command = " merge
    }' "$1"
