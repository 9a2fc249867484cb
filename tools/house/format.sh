#!/usr/bin/env bash
# Every C++ file is as clang-format 14 leaves it. Other versions format differently, so they are not asked.
set -eu
cd "$(dirname "$0")/../.."
if ! clang-format --version 2>/dev/null | grep -q 'version 14\.'; then
  echo "format: skipped, there is no clang-format 14"
  exit 0
fi
tools/house/tracked .h .cpp | xargs -d '\n' -n 20 -P 2 clang-format --dry-run --Werror 2>&1 | grep 'error:' && exit 1
exit 0
