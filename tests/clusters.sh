#!/usr/bin/env bash
# A sweep through a real Slurm and a real HyperQueue on this one machine, each started here and stopped at the end: the table is that
# of the plain command to the bit, with a killed submitter and a lost worker. Then 200 short finite element runs against the plain loop.
# tests/clusters.sh [IBR [slurm|hq]]
# Skipped with a word where one is absent: Slurm needs root and Debian's slurmctld slurmd slurm-client munge, HyperQueue its `hq`.
set -euo pipefail
ibr=$(realpath "${1:-target/release/ibr}")
work=$(mktemp -d)
stop() {
  pkill -f "(slurmd|slurmctld|munged|hq) .*$work" || true
  sleep 1
  rm -rf "$work"
}
trap stop EXIT
cd "$work"

# Their tools; what is absent is said.
has_slurm() {
  for tool in slurmctld slurmd sbatch squeue scancel munged; do
    command -v "$tool" > /dev/null || { echo "slurm: skipped: no $tool here"; return 1; }
  done
  [ "$(id -u)" = 0 ] || { echo "slurm: skipped: a Slurm of its own needs root"; return 1; }
}
has_hq() { command -v hq > /dev/null || { echo "hq: skipped: no hq here"; return 1; }; }

start_slurm() {
  local host
  host=$(hostname -s)
  mkdir -p state spool
  dd if=/dev/urandom of=munge.key bs=64 count=1 status=none
  chmod 700 . && chmod 400 munge.key
  munged --force --socket="$work/munge.socket" --key-file="$work/munge.key" --pid-file="$work/munge.pid" \
    --log-file="$work/munge.log" --seed-file="$work/munge.seed"
  cat > slurm.conf <<CONF
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
}
lose_slurm() { scancel "$1_2" || true; }

start_hq() {
  export HQ_SERVER_DIR="$work/hq-server"
  hq server start --server-dir "$HQ_SERVER_DIR" > hq.log 2>&1 &
  for _ in $(seq 40); do hq server info > /dev/null 2>&1 && break; sleep 0.5; done
  hq_worker
}
hq_worker() {
  hq worker start --cpus "$(nproc)" --server-dir "$HQ_SERVER_DIR" > "worker-$RANDOM.log" 2>&1 &
  worker=$!
}
lose_hq() { kill -9 "$worker"; hq_worker; }

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
cat > short.toml <<'STUDY'
scenario = "epam"
engines = ["finite elements"]
outputs = ["tip"]
[[vary]]
key = "fem.body_mesh_mm"
values = [12]
[[vary]]
key = "fem.actuator_mesh_mm"
values = [12]
[[vary]]
key = "fem.body_ramp_s"
values = [0.004]
[[vary]]
key = "fem.actuator_ramp_s"
values = [0.004]
[[vary]]
key = "fem.seed"
from = 1
to = 200
steps = 200
[[vary]]
key = "pressure_kpa"
values = [4]
STUDY
seconds() { local from=$EPOCHREALTIME; "$@"; echo "$EPOCHREALTIME $from" | awk '{print $1 - $2}' > took; }

{ "$ibr" new fpam; printf '\n[fem]\nbody_ramp_s = 0.004\nactuator_ramp_s = 0.006\n'; } > quick.toml
map=("$ibr" --quiet breakdown quick.toml --mesh 14mm --pressure 10kPa,20kPa --body-pressure 1kPa,3kPa)

"$ibr" --quiet sweep study.toml --out plain > plain.txt
"${map[@]}" --out plain-map --runs plain-runs > plain.txt
# The table of the bench, without the row of the time that a diagnosis takes. It ends with 1 where a row is not met.
bench() { { "$ibr" --quiet bench discovery --sets 4 "$@" || [ $? = 1 ]; } | grep -v '^| full diagnosis'; }
bench > plain-bench.txt
for engine in ${2:-slurm hq}; do
  "has_$engine" || continue
  "start_$engine"
  queue=("$ibr" --quiet sweep study.toml --out "$engine" --engine "$engine" --shards 4 --threads 1)
  "${queue[@]}" > queued.txt &
  submitter=$!
  for _ in $(seq 100); do [ -s "$engine/job.json" ] && break; sleep 0.1; done
  id=$(sed -E 's/.*"id":"([0-9]+)".*/\1/' "$engine/job.json")
  kill -9 "$submitter"
  sleep 0.3
  "lose_$engine" "$id"
  "${queue[@]}" > queued.txt
  cmp plain/table.csv "$engine/table.csv"
  echo "$engine: $(wc -l < "$engine/table.csv") rows, the same to the bit, with a killed submitter and a lost worker"
  "${map[@]}" --out "$engine-map" --runs "$engine-runs" --engine "$engine" --shards 2 > queued.txt
  cmp plain-map/breakdown.csv "$engine-map/breakdown.csv"
  [ -s "$engine-runs/job.sh" ]
  echo "$engine: a breakdown map, the same to the bit"
  bench --out "$engine-bench" --engine "$engine" --shards 2 > "$engine-bench.txt"
  cmp plain-bench.txt "$engine-bench.txt"
  [ -s "$engine-bench/job.sh" ]
  echo "$engine: the bench of the diagnosis, the same table"
  seconds "$ibr" --quiet sweep short.toml --out "loop-for-$engine" --threads "$(nproc)" > short.txt
  loop=$(cat took)
  seconds "$ibr" --quiet sweep short.toml --out "$engine-short" --engine "$engine" --shards "$(nproc)" --threads 1 > short.txt
  cmp "loop-for-$engine/table.csv" "$engine-short/table.csv"
  echo "$engine: 200 short runs take $(awk "{printf \"%.3f\", \$1 / $loop}" took) times the plain loop's $loop s"
done
