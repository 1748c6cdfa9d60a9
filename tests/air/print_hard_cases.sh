#!/bin/sh
# Prints the rows that the hard cases of this run left, if any: case, held against, error reached.
rows=$(cat "$1"/* 2>/dev/null | sort -V)
[ -z "$rows" ] && exit 0
printf '\nhard case                                      held against                                         error reached\n%s\n' "$rows"
