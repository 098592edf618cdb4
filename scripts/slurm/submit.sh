#!/usr/bin/env bash
# Measures a suite on a cluster, and reports when all parts have ended:
#   scripts/slurm/submit.sh PARTS SUITE --out FOLDER [options of 'fracbench run']
# Options of sbatch go into SBATCH_OPTIONS, such as "--time=08:00:00 --partition=cpu". Prints the
# numbers of the two jobs. Call it again to go on: cells that have a record are not measured again.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)

usage() { sed -n '2,5s/^# \{0,1\}//p' "$0" >&2; exit 2; }
[ $# -ge 2 ] || usage
parts=$1; shift
case $parts in *[!0-9]* | "" | 0) usage ;; esac
command -v sbatch >/dev/null || { echo "submit.sh: there is no sbatch; call it where Slurm is" >&2; exit 2; }

fracbench=${FRACBENCH:-$(command -v fracbench || true)}
[ -x "$fracbench" ] || { echo "submit.sh: fracbench is not in PATH; set FRACBENCH to its file" >&2; exit 2; }
export FRACBENCH=$fracbench

# What is wrong with the suite or its options is told here, not in the log of a job.
"$fracbench" run "$@" --dry-run >&2

folder=
for ((k = 1; k <= $#; ++k)); do [ "${!k}" = --out ] && { next=$((k + 1)); folder=${!next:-}; }; done
[ -n "$folder" ] || { echo "submit.sh: name the results folder: --out FOLDER" >&2; exit 2; }
mkdir -p "$folder.log"

read -r -a more <<<"${SBATCH_OPTIONS:-}"
array=$(sbatch --parsable --array="1-$parts" --output="$folder.log/%a.txt" "${more[@]}" \
  "$here/shard.sbatch" "$@")
report=$(sbatch --parsable --dependency="afterany:$array" --job-name=fracbench-report \
  --output="$folder.log/report.txt" "${more[@]}" --wrap "'$fracbench' report '$folder'")
echo "parts  $array"
echo "report $report"
