#!/usr/bin/env bash
# A sweep on a farm of two Slurm nodes, one of which dies in the middle, is byte for byte the sweep
# that this machine makes by itself, but for the wall times in manifests.
#
#   slurm.sh SKYBAKE     exit code 77, skipped, where Slurm or munge is not installed
here=$(cd "$(dirname "$0")" && pwd)
source "$here/slurm_farm.sh"

# --- The sweep ------------------------------------------------------------------------------------

cd "$farm/work"
cat >sky.toml <<'RECIPE'
preset = "earth_hillaire"
[bake.transmittance]
[bake.multiple_scattering]
method = "converged"
mapping = "hillaire"
size = [32, 32]
max_texel_error = "0.02 %"
[sweep]
"atmosphere.ground_albedo" = [0.1, 0.3, 0.5]
"atmosphere.layers.mie.scale_height" = { from = "1.2 km", to = "4.8 km", count = 2, scale = "log" }
RECIPE
"$skybake" sweep sky.toml -o farm --emit commands >commands
bash "$here/../../examples/farm/slurm.sh" commands >jobs
cat jobs
tasks=$(sed -n 's/^tasks //p' jobs)

some_are_done() { [[ $(find farm -name manifest.json 2>/dev/null | wc -l) -ge 2 ]]; }
wait_for "the first variants" some_are_done
# The node dies: its daemon, the keepers of its tasks and the tasks, all at once, so that none is left
# to tell the controller. They are stopped first. Where the program is not among them the task has
# ended in the meantime: then the node goes on, and dies with the next one.
second_is_at_work() { [[ -n $(squeue --noheader --states=running --nodelist=n2) ]]; }
queue_is_empty() { [[ -z $(squeue --noheader) ]]; }
at_work_or_at_the_end() { second_is_at_work || queue_is_empty; }
signal_second() {
    local process
    for process in $victims; do kill -"$1" "$process" 2>/dev/null || true; done
}
stop_second() {
    local process keeper
    victims=$second programs=0
    dying=$(squeue --noheader --states=running --nodelist=n2 --format=%i | head -n 1)
    for process in $(processes SLURMD_NODENAME=n2); do
        keeper=$(sed -n 's/^PPid:\t//p' "/proc/$process/status" 2>/dev/null || true)
        if grep -q slurmstepd "/proc/${keeper:-0}/comm" 2>/dev/null; then victims="$victims $keeper"; fi
        victims="$victims $process"
    done
    signal_second STOP
    for process in $victims; do
        [[ ! "/proc/$process/exe" -ef "$skybake" ]] || programs=$((programs + 1))
    done
    ((programs > 0))
}
wait_for "a task on the second node" at_work_or_at_the_end
until stop_second; do
    signal_second CONT
    wait_for "another task on the second node" at_work_or_at_the_end
    second_is_at_work || { echo "no task was caught at work"; exit 1; }
done
signal_second KILL
echo "the second node died while it made task $dying"

wait_for "the end of all jobs" queue_is_empty
requeues=$(scontrol show job "$tasks" | grep -c 'Restarts=[1-9]' || true)
echo "$requeues task requeued"
[[ $requeues -ge 1 ]] || { echo "no task was lost with the node"; exit 1; }

# --- The same at home -----------------------------------------------------------------------------

"$skybake" sweep sky.toml -o home -q >/dev/null
# timing.csv holds nothing else.
without_times() { [[ $1 == */timing.csv ]] || sed -z 's/"timing": {[^}]*}//g; s/"hash": "[^"]*"//g' "$1"; }
compared=0
while read -r file; do
    if ! cmp <(without_times "home/$file") <(without_times "farm/$file"); then
        echo "differs: $file"
        exit 1
    fi
    compared=$((compared + 1))
done < <(cd home && find . -type f | sort)
diff <(cd home && find . -type f | sort) <(cd farm && find . -type f | sort)
[[ $compared -eq $((6 * 3 + 4)) ]] || { echo "$compared files compared"; exit 1; }
echo "$compared files of 6 variants are the same"
