#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds everything and runs every test. The last line is `N passed, N failed`; the exit code is 0 when none failed.
#   tools/test.sh [--quick] [OPTION|FILE...]    options and files of build/bin/rung_test_runner (--help)
# --quick: without the compilers for other processors, which are 0.9 of 1 GB to download, and without the tests that need
# them; it names these.
set -eu
cd "$(dirname "$0")/.."
case " $* " in
  *" --quick "*) tools/install-packages.sh --quick ;;
  *) tools/install-packages.sh --tests ;;
esac
log=$(mktemp)
trap 'rm -f "$log"' EXIT
{ cmake --preset release -DRUNG_CAM_FIT=ON && cmake --build build; } >"$log" 2>&1 || { tail -40 "$log"; echo "0 passed, 1 failed"; exit 1; }
rm -f "$log"
exec build/bin/rung_test_runner "$@"
