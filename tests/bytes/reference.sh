#!/usr/bin/env bash
# Bakes the reference: by the program as it is here, with as many threads as the machine has.
source "$(dirname "$0")/common.sh"
bake "$reference" "$program"
