#!/usr/bin/env bash
# Installs what is missing, builds and runs the tests. Arguments go to ctest, e.g. -R cvd or -L geometry.
# FRACBENCH_PRESET=sanitize (or debug) tests another build.
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

preset=${FRACBENCH_PRESET:-release}
FRACBENCH_WITH_TESTS=1 ./scripts/install.sh
say "building ($preset)"
build "$preset"
say "testing"
# One more than there are processors: many tests wait for processes or for the disk.
ctest --preset "$preset" --parallel "$(($(nproc) + 1))" "$@"
