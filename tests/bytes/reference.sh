#!/usr/bin/env bash
# What the others compare with: the program as it is here, with as many threads as the machine has.
source "$(dirname "$0")/common.sh"
bake "$reference" "$program"
