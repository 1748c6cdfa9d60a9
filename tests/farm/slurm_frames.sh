#!/usr/bin/env bash
# The frames of a sequence on a farm of two Slurm nodes: each is made once, by one task, and is byte for byte
# that of one bake of all.
#
#   slurm_frames.sh SKYBAKE     exit code 77, skipped, where Slurm or munge is not installed
source "$(dirname "$0")/slurm_farm.sh"
python3 "$(dirname "$0")/frames.py" "$skybake" "$farm/work" slurm
