#!/usr/bin/env bash
# A sweep on a farm of two Slurm nodes, one of which dies in the middle, is byte for byte the sweep
# that this machine makes by itself, but for the wall times in manifests.
#
#   slurm.sh SKYBAKE     exit code 77, skipped, where Slurm or munge is not installed
#
# All daemons are private: they live in a temporary folder, speak on loopback alone and end with
# the test. Debian: apt-get install slurm-wlm
set -euo pipefail

skybake=$(realpath "$1")
for program in munged slurmctld slurmd sbatch squeue sinfo scontrol; do
    if ! PATH=$PATH:/usr/sbin command -v "$program" >/dev/null; then
        echo "skipped: $program is not installed (Debian: slurm-wlm, munge)"
        exit 77
    fi
done
export PATH=$PATH:/usr/sbin

farm=$(mktemp -d "${TMPDIR:-/tmp}/skybake-farm-XXXXXX")
export SKYBAKE_FARM=$farm SLURM_CONF=$farm/slurm.conf
unset SKYBAKE_CACHE_DIR

# processes WORD: those that have WORD, NAME=VALUE, in their environment, but for this script
processes() {
    grep -lzsxF -- "$1" /proc/[0-9]*/environ | tr -dc '0-9\n' | grep -vx -e "$$" -e "$BASHPID" || true
}
# The processes that this test has started, by what they inherit: daemons leave their parents.
farm_processes() { processes "SKYBAKE_FARM=$farm"; }

clean_up() {
    local code=$? process
    trap - EXIT
    if [[ $code -ne 0 ]]; then
        tail -n 30 "$farm"/*.log "$farm"/work/*.out 2>/dev/null || true
    fi
    for _ in 1 2 3; do
        for process in $(farm_processes); do kill -KILL "$process" 2>/dev/null || true; done
        sleep 0.2
    done
    wait
    rm -rf "$farm"
    exit "$code"
}
trap clean_up EXIT
trap 'exit 130' INT TERM

# wait_for WHAT COMMAND...: no test of how long it takes; the end comes where it never does
wait_for() {
    local end=$((SECONDS + 1800)) what=$1
    shift
    until "$@" >/dev/null 2>&1; do
        if ((SECONDS >= end)); then
            echo "waited in vain: $what"
            exit 1
        fi
        sleep 0.2
    done
}

# --- The farm -------------------------------------------------------------------------------------

user=$(id -un)
host=$(hostname -s)
# The controller listens where its host's name leads; Debian's installer gives names 127.0.1.1.
address=$(getent ahostsv4 "$host" | awk '$1 ~ /^127[.]/ {print $1; exit}')
address=${address:-127.0.0.1}
read -r controller_port first_port second_port < <(python3 - "$address" <<'PORTS'
import socket, sys
sockets = [socket.socket() for _ in range(3)]
for one in sockets:
    one.bind((sys.argv[1], 0))
print(*(one.getsockname()[1] for one in sockets))
PORTS
)
chmod 755 "$farm"
mkdir -p "$farm/state" "$farm/spool.n1" "$farm/spool.n2" "$farm/work"
(umask 077 && head -c 1024 /dev/urandom >"$farm/munge.key")
cat >"$SLURM_CONF" <<CONF
ClusterName=skybake
SlurmctldHost=$host($address)
SlurmctldPort=$controller_port
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
# A requeued task starts once the credential of its first start has expired.
AuthInfo=socket=$farm/munge.socket,cred_expire=5
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
StateSaveLocation=$farm/state
SlurmdSpoolDir=$farm/spool.%n
SlurmctldPidFile=$farm/slurmctld.pid
SlurmdPidFile=$farm/slurmd.%n.pid
SlurmctldLogFile=$farm/slurmctld.log
SlurmdLogFile=$farm/slurmd.%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/builtin
SlurmdTimeout=6
MessageTimeout=5
KillWait=2
JobRequeue=1
ReturnToService=2
NodeName=n1 NodeHostname=$host NodeAddr=$address Port=$first_port CPUs=1 State=UNKNOWN
NodeName=n2 NodeHostname=$host NodeAddr=$address Port=$second_port CPUs=1 State=UNKNOWN
PartitionName=all Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
CONF

munged --foreground --force --key-file="$farm/munge.key" --socket="$farm/munge.socket" \
    --pid-file="$farm/munged.pid" --log-file="$farm/munged.log" --seed-file="$farm/munge.seed" \
    >/dev/null 2>&1 &
wait_for "munge's socket" test -S "$farm/munge.socket"
slurmctld -D -c >/dev/null 2>&1 &
slurmd -D -N n1 -c >/dev/null 2>&1 &
slurmd -D -N n2 -c >/dev/null 2>&1 &
second=$!
nodes_are_idle() { [[ $(sinfo --noheader --Node --states=idle | wc -l) == 2 ]]; }
wait_for "two idle nodes" nodes_are_idle

# --- The sweep ------------------------------------------------------------------------------------

cd "$farm/work"
cat >sky.toml <<'RECIPE'
preset = "earth_hillaire"
[bake.transmittance]
[bake.multiple_scattering]
size = [64, 64]
max_texel_error = "0.02 %"
[sweep]
"atmosphere.ground_albedo" = [0.1, 0.3, 0.5]
"atmosphere.layers.mie.scale_height" = { from = "1.2 km", to = "4.8 km", count = 4, scale = "log" }
RECIPE
"$skybake" sweep sky.toml -o farm --emit slurm >submit.sh
bash submit.sh >jobs
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
without_times() { sed -z 's/"timing": {[^}]*}//g; s/"hash": "[^"]*"//g' "$1"; }
compared=0
while read -r file; do
    if ! cmp <(without_times "home/$file") <(without_times "farm/$file"); then
        echo "differs: $file"
        exit 1
    fi
    compared=$((compared + 1))
done < <(cd home && find . -type f | sort)
diff <(cd home && find . -type f | sort) <(cd farm && find . -type f | sort)
[[ $compared -eq $((12 * 3 + 3)) ]] || { echo "$compared files compared"; exit 1; }
echo "$compared files of 12 variants are the same"
