# Shared by the scripts of this folder; to be sourced. Goes to the repository's root.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

say() { printf '\n== %s\n' "$*"; }

# The packages that are named in third_party/packages-debian.txt.
wanted_packages() { sed -e 's/#.*//' -e '/^[[:space:]]*$/d' third_party/packages-debian.txt; }

# Compile units that fit the machine: each of the largest ones (CGAL) takes about 2.5 GB.
build_jobs() {
  local by_memory
  by_memory=$(awk '/^MemAvailable/ {print int($2 / 2500000)}' /proc/meminfo)
  local cores
  cores=$(nproc)
  local jobs=$((by_memory < cores ? by_memory : cores))
  echo $((jobs < 1 ? 1 : jobs))
}

build() {
  local preset=$1
  cmake --preset "$preset" -S . >build-configure.log 2>&1 || { cat build-configure.log; rm -f build-configure.log; exit 1; }
  rm -f build-configure.log
  cmake --build --preset "$preset" --parallel "$(build_jobs)"
}
