#!/usr/bin/env bash
# A sweep through a real Slurm on this one machine: started here, with its own configuration, and stopped at the end.
# tests/slurm.sh [IBR]; skipped with a word where Slurm is not installed (Debian: slurmctld slurmd slurm-client munge) or not root.
set -euo pipefail
ibr=$(realpath "${1:-target/release/ibr}")
for tool in slurmctld slurmd sbatch squeue scancel munged; do
  command -v "$tool" > /dev/null || { echo "skipped: no $tool here"; exit 0; }
done
[ "$(id -u)" = 0 ] || { echo "skipped: a Slurm of its own needs root"; exit 0; }
work=$(mktemp -d)
stop() {
  pkill -f "slurmd.*$work" || true
  pkill -f "slurmctld.*$work" || true
  pkill -f "munged.*$work" || true
  sleep 1
  rm -rf "$work"
}
trap stop EXIT
host=$(hostname -s)
mkdir -p "$work/state" "$work/spool"
dd if=/dev/urandom of="$work/munge.key" bs=64 count=1 status=none
chmod 700 "$work" && chmod 400 "$work/munge.key"
munged --force --socket="$work/munge.socket" --key-file="$work/munge.key" --pid-file="$work/munge.pid" \
  --log-file="$work/munge.log" --seed-file="$work/munge.seed"
cat > "$work/slurm.conf" <<CONF
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$work/munge.socket
CryptoType=crypto/munge
ProctrackType=proctrack/pgid
TaskPlugin=task/none
MpiDefault=none
ReturnToService=2
SlurmctldPort=16817
SlurmdPort=16818
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd.log
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SchedulerParameters=sched_interval=1,batch_sched_delay=0
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) RealMemory=1000
PartitionName=main Nodes=ALL Default=YES State=UP
CONF
export SLURM_CONF="$work/slurm.conf"
slurmctld -f "$SLURM_CONF"
slurmd -f "$SLURM_CONF"
for _ in $(seq 40); do
  sinfo -h -o %T 2> /dev/null | grep -q idle && break
  sleep 0.5
done
cd "$work"
cat > study.toml <<'STUDY'
scenario = "epam"
engines = ["reduced"]
[[vary]]
key = "actuator.width_mm"
from = 40
to = 60
steps = 200
[[vary]]
key = "pressure_kpa"
from = 0
to = 30
steps = 4096
STUDY
"$ibr" --quiet sweep study.toml --out plain > plain.txt
"$ibr" --quiet sweep study.toml --out queued --engine slurm --shards 4 --threads 1 > queued.txt &
submitter=$!
# A killed worker and a killed submitter lose nothing.
for _ in $(seq 100); do [ -s queued/job.json ] && break; sleep 0.1; done
id=$(sed -E 's/.*"id":"([0-9]+)".*/\1/' queued/job.json)
kill -9 "$submitter"
sleep 0.5
scancel "${id}_2" || true
"$ibr" --quiet sweep study.toml --out queued --engine slurm --shards 4 --threads 1 > queued.txt
cmp plain/table.csv queued/table.csv
echo "slurm: $(wc -l < queued/table.csv) rows, the same to the bit, with a killed submitter and a cancelled task"
