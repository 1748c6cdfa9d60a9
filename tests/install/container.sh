#!/usr/bin/env bash
# Builds the image of examples/Containerfile from HEAD and bakes in it. Debian's image is made here, of the
# machine's own package sources, so that no registry of images is needed.
#   container.sh FOLDER     needs root, buildah and mmdebstrap; exit code 77 where they are missing
set -euo pipefail
skip() { echo "skipped: $1"; exit 77; }
((EUID == 0)) || skip "it needs root"
for program in buildah mmdebstrap; do
    command -v $program >/dev/null || skip "there is no $program"
done
source=$(git -C "$(dirname "$0")" rev-parse --show-toplevel)
folder=$1
rm -rf --one-file-system "$folder"
mkdir -p "$folder/tree/build" "$folder/work"

# Images stay in a store of this test. With this isolation they need no control groups.
export BUILDAH_ISOLATION=chroot
in_store() { command buildah --root "$folder/store" --runroot "$folder/run" "$@"; }
clean_up() {
    in_store rm --all >/dev/null 2>&1 || true
    in_store rmi --all --force >/dev/null 2>&1 || true
    rm -rf --one-file-system "$folder"
}
trap clean_up EXIT
sources=/etc/apt/sources.list.d/debian.sources
[[ -s $sources ]] || sources=/etc/apt/sources.list
mmdebstrap --quiet --variant=minbase bookworm "$folder/debian.tar" "$sources"
debian=$(in_store from scratch)
in_store add --quiet "$debian" "$folder/debian.tar" / >/dev/null
in_store commit --quiet "$debian" docker.io/library/debian:bookworm-slim >/dev/null

git -C "$source" archive HEAD | tar -x -C "$folder/tree"
echo "if this were copied, cmake would fail" >"$folder/tree/build/quickstart"  # .dockerignore leaves it out
(cd "$folder/tree" && in_store build --network host --pull-never --file examples/Containerfile --tag skybake .) \
    >"$folder/log" 2>&1 || { tail -n 50 "$folder/log"; exit 1; }

[[ $(in_store inspect --type image --format '{{.OCIv1.Config.Entrypoint}}' skybake) == '[skybake]' ]]
container=$(in_store from --pull-never skybake)
in_image() {
    in_store run --network none --volume "$folder/work:/work" --workingdir /work "$container" -- skybake "$@"
}
in_image --version
in_image init mars.toml --preset mars
in_image bake mars.toml --only transmittance
in_image verify out
in_image preview mars.toml --only transmittance
in_store images --format '{{.Name}}: {{.Size}}'
