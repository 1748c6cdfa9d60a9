#!/usr/bin/env bash
# The frames of a sequence on a farm of two Slurm nodes: each is made once, by one task, and is byte for byte
# that of one bake of all.
#
#   slurm_frames.sh SKYBAKE     exit code 77, skipped, where Slurm or munge is not installed
here=$(cd "$(dirname "$0")" && pwd)
source "$here/slurm_farm.sh"
cd "$farm/work"  # where Slurm puts what jobs say
python3 "$here/frames.py" "$skybake" "$farm/work" slurm
