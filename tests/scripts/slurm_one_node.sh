#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs a batch and an experiment through Slurm on this machine alone: starts munged, slurmctld and
# slurmd with files of their own in a temporary folder, runs short simulated recordings with
# `scripts/batch --slurm` and `scripts/experiment --slurm`, and ends them again. Needs root and
# Debian's munge, slurmctld, slurmd and slurm-client; exits with 77 (skipped) where they are missing
# or cannot be started.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
build="${TRAJLO_BUILD_DIR:-$root/build}"

skip() {
  echo "slurm_one_node.sh: skipped: $*" >&2
  exit 77
}
[[ "$(id -u)" -eq 0 ]] || skip "it needs root"
for program in munged slurmctld slurmd sbatch scontrol snakemake; do
  PATH="$PATH:/usr/sbin" command -v "$program" >/dev/null || skip "$program is not installed"
done
for program in trajlo_run trajlo_simulate trajlo_evaluate; do
  [[ -x "$build/apps/$program" ]] || skip "$build/apps/$program is not built"
done
export PATH="$PATH:/usr/sbin"

folder="$(mktemp -d -t trajlo_slurm.XXXXXX)"
children=()
finish() {
  for child in "${children[@]}"; do
    kill "$child" 2>/dev/null || true
    wait "$child" 2>/dev/null || true
  done
  rm -rf "$folder"
}
trap finish EXIT

# munged refuses keys and sockets below folders that others may write to unless it is forced; that
# is right for a cluster and no matter here.
mkdir -p "$folder/munge" "$folder/state" "$folder/spool"
chmod 755 "$folder" "$folder/munge"
head -c 1024 /dev/urandom >"$folder/munge/key"
chmod 400 "$folder/munge/key"
munged --foreground --force --key-file="$folder/munge/key" --socket="$folder/munge/socket" \
  --pid-file="$folder/munge/pid" --log-file="$folder/munge/log" \
  --seed-file="$folder/munge/seed" &>"$folder/munge.log" &
children+=($!)

node="$(hostname -s)"
cat >"$folder/slurm.conf" <<CONFIG
ClusterName=one
SlurmctldHost=$node(127.0.0.1)
SlurmctldPort=16817
SlurmdPort=16818
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge/socket
CredType=cred/munge
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
ReturnToService=2
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
NodeName=$node NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=$node Default=YES MaxTime=INFINITE State=UP
CONFIG
printf "CgroupPlugin=cgroup/v1\nCgroupAutomount=no\n" >"$folder/cgroup.conf"
export SLURM_CONF="$folder/slurm.conf"

slurmctld -D -f "$SLURM_CONF" &>"$folder/slurmctld.log" &
children+=($!)
slurmd -D -f "$SLURM_CONF" -N "$node" &>"$folder/slurmd.log" &
children+=($!)
for _ in $(seq 60); do
  state="$(sinfo --noheader --format=%t 2>/dev/null || true)"
  [[ "$state" == idle ]] && break
  sleep 0.5
done
if [[ "$state" != idle ]]; then
  tail -n 5 "$folder"/{munge,slurmctld,slurmd}.log >&2
  skip "Slurm did not come up on this machine (node state: '$state')"
fi

cat >"$folder/suite.yaml" <<'SUITE'
title: Two short flights through Slurm
defaults: {duration_s: 3, seeds: [1, 2]}
sequences:
  - simulate: hall_os1_16
configurations:
  - name: plain
SUITE
"$root/scripts/batch" "$folder/suite.yaml" --output "$folder/out" --build "$build" --slurm -j 4 \
  --sbatch=--partition=all || { tail -n 40 "$folder/out/snakemake.log" >&2; exit 1; }

finished=("$folder"/out/plain/*/status.json)
logs=("$folder"/out/slurm/*.log)
[[ ${#finished[@]} -eq 2 ]] || { echo "${#finished[@]} of 2 runs have ended" >&2; exit 1; }
# A recording, a run, an evaluation and a page of each: all of them were jobs of Slurm.
[[ ${#logs[@]} -eq 8 ]] || { echo "${#logs[@]} of 8 jobs went through Slurm" >&2; exit 1; }

cat >"$folder/experiment.yaml" <<'EXPERIMENT'
title: Two windows through Slurm
design: {kind: grid}
vary:
  window.segments: [2, 4]
defaults: {duration_s: 2, seeds: [1]}
sequences:
  - simulate: hall_os1_16
EXPERIMENT
"$root/scripts/experiment" "$folder/experiment.yaml" --output "$folder/sweep" --build "$build" \
  --slurm -j 4 --sbatch=--partition=all ||
  { tail -n 40 "$folder/sweep/snakemake.log" >&2; exit 1; }
rows="$(grep -c ',ok,' "$folder/sweep/results.csv" || true)"
[[ "$rows" -eq 2 ]] || { echo "$rows of 2 rows are ok" >&2; exit 1; }
[[ -s "$folder/sweep/report.html" ]] || { echo "the experiment has no page" >&2; exit 1; }
# A recording, and a run and an evaluation of each row.
sweep_logs=("$folder"/sweep/slurm/*.log)
[[ ${#sweep_logs[@]} -eq 5 ]] ||
  { echo "${#sweep_logs[@]} of 5 jobs of the experiment went through Slurm" >&2; exit 1; }
echo "slurm_one_node.sh: $((${#logs[@]} + ${#sweep_logs[@]})) jobs," \
  "${#finished[@]} runs of a batch, $rows of an experiment"
