#!/usr/bin/env bash
# Another locale, folder, time zone, user name and home.
source "$(dirname "$0")/common.sh"
mkdir -p "$work/else where"
cd "$work/else where"
elsewhere() {
    LC_ALL=de_DE.UTF-8 LANG=de_DE.UTF-8 TZ=Pacific/Auckland HOME=/nowhere USER=nobody COLUMNS=40 \
        "$program" "$@"
}
bake "$work/else where/there" elsewhere
same "$reference" "$work/else where/there"
