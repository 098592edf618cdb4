#!/usr/bin/env bash
# Fuzzes the readers of all files that come from outside, under address and undefined-behaviour
# sanitizers: fuzz.sh [SECONDS] [TARGET ...], 10 s for each target where nothing is said. Inputs that
# were found are kept below build/fuzz/corpus, what breaks a reader below build/fuzz/found.
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

seconds=10
case "${1:-}" in
  "") ;;
  -h | --help) sed -n '2,4s/^# //p' "${BASH_SOURCE[0]}"; exit 0 ;;
  *[!0-9]*) ;;
  *) seconds=$1; shift ;;
esac

FRACBENCH_WITH_FUZZ=1 ./scripts/install.sh

targets=("$@")
if [ ${#targets[@]} -eq 0 ]; then
  for file in tests/fuzz/*_fuzz.cpp; do targets+=("$(basename "$file" _fuzz.cpp)"); done
fi

say "building (fuzz)"
for target in "${targets[@]}"; do
  [ -f "tests/fuzz/${target}_fuzz.cpp" ] || { echo "there is no fuzz target '$target'" >&2; exit 2; }
  build fuzz "${target}_fuzz"
done

export LSAN_OPTIONS="suppressions=$PWD/tests/leaks-of-libraries.txt:print_suppressions=0"
failed=()
for target in "${targets[@]}"; do
  say "fuzzing $target for $seconds s"
  corpus=build/fuzz/corpus/$target
  mkdir -p "$corpus" build/fuzz/found
  log=build/fuzz/found/$target.log
  if ! "build/fuzz/bin/${target}_fuzz" "$corpus" "tests/fuzz/corpus/$target" \
    -max_total_time="$seconds" -timeout=10 -rss_limit_mb=4000 \
    -artifact_prefix="build/fuzz/found/$target-" >"$log" 2>&1; then
    tail -30 "$log"
    failed+=("$target")
  else
    grep -E '^(Done|#[0-9]+.*(INITED|DONE))' "$log" | tail -2
  fi
done
if [ ${#failed[@]} -gt 0 ]; then
  say "failed: ${failed[*]}; the inputs are in build/fuzz/found"
  exit 1
fi
