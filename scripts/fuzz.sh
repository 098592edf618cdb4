#!/usr/bin/env bash
# Fuzzes the readers of all files that come from outside, under address and undefined-behaviour
# sanitizers: fuzz.sh [SECONDS] [TARGET ...], 10 s for each target where nothing is said, as many at
# a time as there are cores; 0 s runs the seeds alone. So it does for the target record unless that
# is named: it finds what brings down libhdf5 itself. Inputs that were found are kept below
# build/fuzz/corpus, what breaks a reader below build/fuzz/found.
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

seconds=10
case "${1:-}" in
  "") ;;
  -h | --help) sed -n '2,6s/^# //p' "${BASH_SOURCE[0]}"; exit 0 ;;
  *[!0-9]*) ;;
  *) seconds=$1; shift ;;
esac
all=()
for file in tests/fuzz/*_fuzz.cpp; do all+=("$(basename "$file" _fuzz.cpp)"); done
targets=("$@")
seeds_only=
if [ ${#targets[@]} -eq 0 ]; then
  targets=("${all[@]}")
  seeds_only=record
fi
for target in "${targets[@]}"; do
  [ -f "tests/fuzz/${target}_fuzz.cpp" ] ||
    { echo "there is no fuzz target '$target', but ${all[*]}" >&2; exit 2; }
done

FRACBENCH_WITH_FUZZ=1 ./scripts/install.sh
say "building (fuzz)"
build fuzz "${targets[@]/%/_fuzz}"

# fuzz_one TARGET: says how it went, and leaves the inputs that break it.
fuzz_one() {
  local target=$1
  local corpus=build/fuzz/corpus/$target log=build/fuzz/found/$target.log
  local limit=(-max_total_time="$seconds")
  [ "$seconds" = 0 ] || [ "$target" = "$seeds_only" ] && limit=(-runs=0)
  mkdir -p "$corpus"
  # The same seed each time: what was found before, in the corpus, is where the next run begins.
  if "build/fuzz/bin/${target}_fuzz" "$corpus" "tests/fuzz/corpus/$target" "${limit[@]}" -seed=1 \
    -timeout=10 -rss_limit_mb=4000 -artifact_prefix="build/fuzz/found/$target-" >"$log" 2>&1; then
    echo "$target: $(grep -E '^(Done|#[0-9]+.*(INITED|DONE))' "$log" | tail -1)"
  else
    tail -30 "$log"
    echo "$target: failed; the input is in build/fuzz/found"
    return 1
  fi
}

say "fuzzing ${targets[*]}, $seconds s each"
mkdir -p build/fuzz/found
export LSAN_OPTIONS="suppressions=$PWD/tests/leaks-of-libraries.txt:print_suppressions=0"
export seconds seeds_only
export -f fuzz_one
printf '%s\n' "${targets[@]}" | xargs -P "$(nproc)" -I{} bash -c 'fuzz_one {}'
