#!/usr/bin/env bash
# Builds everything and runs every test. The last line is `N passed, N failed`; the exit code is 0 when none failed.
#   tools/test.sh [OPTION|FILE...]    options and files of build/bin/rung_test_runner (--help)
set -eu
cd "$(dirname "$0")/.."
tools/install-packages.sh --tests
log=$(mktemp)
trap 'rm -f "$log"' EXIT
{ cmake --preset release -DRUNG_CAM_FIT=ON && cmake --build build; } >"$log" 2>&1 || { tail -40 "$log"; echo "0 passed, 1 failed"; exit 1; }
rm -f "$log"
exec build/bin/rung_test_runner "$@"
