# Shared by the scripts of this folder; to be sourced. Goes to the repository's root.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

say() { printf '\n== %s\n' "$*"; }

# The packages that are named in third_party/packages-debian.txt, and those of the tests and of
# fuzzing where they are wanted.
wanted_packages() {
  local lists=(third_party/packages-debian.txt)
  [ -n "${FRACBENCH_WITH_TESTS:-}" ] && lists+=(third_party/packages-debian-tests.txt)
  [ -n "${FRACBENCH_WITH_FUZZ:-}" ] && lists+=(third_party/packages-debian-fuzz.txt)
  sed -e 's/#.*//' -e '/^[[:space:]]*$/d' "${lists[@]}"
}

# Compile units that fit the machine: each of the largest ones (CGAL) takes about 2.5 GB.
build_jobs() {
  local by_memory
  by_memory=$(awk '/^MemAvailable/ {print int($2 / 2500000)}' /proc/meminfo)
  local cores
  cores=$(nproc)
  local jobs=$((by_memory < cores ? by_memory : cores))
  echo $((jobs < 1 ? 1 : jobs))
}

# build PRESET [TARGET ...]: configures and builds everything, or these targets.
build() {
  local preset=$1
  shift
  local log
  log=$(mktemp)
  cmake --preset "$preset" -S . >"$log" 2>&1 || { cat "$log"; rm -f "$log"; exit 1; }
  rm -f "$log"
  cmake --build --preset "$preset" --target "${@:-all}" --parallel "$(build_jobs)"
}
