# A farm of two Slurm nodes in a temporary folder, $farm, for tests that source this file with the program as
# their first argument, $skybake. Ends with 77, skipped, where Slurm or munge is not installed.
#
# All daemons are private: they speak on loopback alone and end with the test.
# Debian: apt-get install slurm-wlm
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
# Ended jobs are asked for at the end of a test, however slow the machine is.
MinJobAge=86400
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
