#!/usr/bin/env bash
# The gallery is drawn by its script: from a copy of the examples, the cheapest picture of its page, and
# the cheapest presets on a contact sheet.
#   gallery.sh SOURCE SKYBAKE
set -euo pipefail
export SKYBAKE=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp -r "$1/examples" "$folder/examples"
cd "$folder"
fail() { echo "$*"; exit 1; }

# Each picture of the page has its recipe and its command.
shown=$(grep -c '^!\[' examples/gallery.md)
made=$(grep -cE '^`skybake preview [a-z_]+\.toml[^`]*` makes it, `[a-zA-Z0-9_]+\.png`, in [0-9]+ s\.$' examples/gallery.md)
recipes=$(grep -c '^```toml$' examples/gallery.md)
((shown == made && shown == recipes)) || fail "$shown pictures, $recipes recipes, $made commands"

rm examples/pictures/cloud_phase.png
sed -i 's/^\(`skybake preview cloud_phase.toml.* in \)[0-9]* s/\19999 s/' examples/gallery.md
examples/gallery.sh --page cloud_phase
[[ -s examples/pictures/cloud_phase.png ]] || fail "the page's picture was not made"
! grep -q ' in 9999 s' examples/gallery.md || fail "the page does not say how long it took"

command -v montage >/dev/null || { echo "skipped: imagemagick is not installed"; exit 77; }
ONLY='^(particles\.haze|noise\.tufts)$' examples/gallery.sh sheets presets
[[ $(ls sheets/presets | sort | xargs) == "noise.tufts noise.tufts.toml particles.haze particles.haze.toml" ]] ||
    fail "$(ls sheets/presets)"
pictures=$(find sheets/presets -name '*.png' | wc -l)
((pictures >= 3)) && [[ -s sheets/presets_others.png ]] || fail "$pictures pictures and no sheet of them"
