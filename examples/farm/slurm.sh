#!/usr/bin/env bash
# Submits a sweep to Slurm: an array job of its tasks, and after them the merge.
#
#   skybake sweep sky.toml -o sweep --emit commands > tasks
#   bash slurm.sh tasks [options of sbatch, such as --partition=render]
#
# Nodes read the file of tasks while they run. Tasks may be requeued or run again: what is up to date is
# left alone. The merge runs whatever becomes of them, and lists what is missing.
set -euo pipefail
tasks=$(realpath "$1")
shift
threads=$(sed -n '1s/.* -j \([0-9]*\) --shard .*/\1/p' "$tasks")
merge=$(sed -n '1s| -j [0-9]* --shard [0-9/]*$| --merge|p' "$tasks")

array=$(sbatch "$@" --parsable --job-name=skybake-sweep --array="1-$(wc -l <"$tasks")" --ntasks=1 \
    --cpus-per-task="$threads" --requeue <<TASK
#!/usr/bin/env bash
exec sh -c "\$(sed -n "\${SLURM_ARRAY_TASK_ID}p" $(printf %q "$tasks"))"
TASK
)
last=$(sbatch "$@" --parsable --job-name=skybake-merge --dependency="afterany:${array%%;*}" --ntasks=1 --requeue <<MERGE
#!/usr/bin/env bash
exec $merge
MERGE
)

echo "tasks ${array%%;*}"
echo "merge ${last%%;*}"
