#!/usr/bin/env bash
# run.sh FRACBENCH FOLDER [--accept WHY]: measures the suite beside this file in FOLDER and compares
# it with baseline.json; with --accept it becomes the new baseline.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
fracbench=$(realpath "$1") folder=$(realpath -m "$2")
cd "$here"
rm -rf "$folder"
export FRACBENCH_CACHE=  # nothing that an earlier build has prepared
"$fracbench" run regression.toml --out "$folder" 2>"$folder.log" || { cat "$folder.log"; exit 1; }
if [ "${3:-}" = --accept ]; then
  exec "$fracbench" compare baseline.json "$folder" --gates gates.toml --accept --why "$4" \
    --who "${FRACBENCH_WHO:-a maintainer}"
fi
"$fracbench" compare baseline.json "$folder" --gates gates.toml || {
  code=$?
  echo "Where this is meant: tests/regression/run.sh FRACBENCH FOLDER --accept WHY"
  exit $code
}
