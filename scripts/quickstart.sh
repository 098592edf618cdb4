#!/usr/bin/env bash
# Installs what is missing, builds, runs the quick suite and says where its report is.
# Can be called again: what is there already is not made anew.
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

case "${1:-}" in
  "") ;;
  -h | --help) sed -n '2,3s/^# //p' "${BASH_SOURCE[0]}"; exit 0 ;;
  *) echo "quickstart.sh takes no arguments; see --help" >&2; exit 2 ;;
esac

./scripts/install.sh
say "building (a first build takes some minutes)"
build release fracbench fracbench-train  # which deepfracture calls
say "running the quick suite"
build/release/bin/fracbench run quick --out results/quick --jobs "$(nproc)"
build/release/bin/fracbench report results/quick --out results/quick/report
say "done"
echo "report:      results/quick/report/index.html (open it in a browser), report.md"
echo "the program: build/release/bin/fracbench --help"
echo "the tests:   ./scripts/test.sh"
