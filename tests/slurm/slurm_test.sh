#!/usr/bin/env bash
# slurm_test.sh FRACBENCH SOURCE FOLDER: a suite in three parts on a real Slurm, one part of it ended
# by the time limit's signal and put back into the queue. Skipped (77) where there is no Slurm.
set -euo pipefail
export FRACBENCH=$1 FRACBENCH_CACHE=
source=$2 folder=$3
sinfo -h >/dev/null 2>&1 || { echo "no Slurm answers here"; exit 77; }
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"
cat >suite.toml <<'SUITE'
shapes = ["sphere", "cube"]
[[scenario]]
family = "single"
count = 12
[[method]]
name = "cvd"
SUITE

wait_for() {
  for _ in $(seq 300); do
    [ -z "$(squeue -h -j "$1" 2>/dev/null)" ] && return
    sleep 1
  done
  echo "job $1 does not end"; squeue; exit 1
}

"$source/scripts/slurm/submit.sh" 3 suite.toml --out results --jobs 1 | tee jobs
parts=$(awk '/^parts/ {print $2}' jobs) report=$(awk '/^report/ {print $2}' jobs)
# Once it has begun, the first part is asked to stop as Slurm does before the time is over.
for _ in $(seq 100); do ls results/records/*.h5 >/dev/null 2>&1 && break; sleep 0.1; done
scancel --batch --signal=INT "${parts}_1" || echo "the first part had ended already"
wait_for "$parts"
wait_for "$report"

"$FRACBENCH" run suite.toml --out results --dry-run | tee dry
records=$(ls results/records/*.h5 | wc -l)
cat results.log/*.txt
[ "$records" -eq 24 ] || { echo "$records of 24 cells have a record"; exit 1; }
[ -s results/report/index.html ] || { echo "there is no report"; exit 1; }

# One process gives the same results.
"$FRACBENCH" run suite.toml --out alone 2>/dev/null
"$FRACBENCH" compare alone results --json >compared.json || { cat compared.json; exit 1; }
echo "24 cells in three parts; the same as in one"
