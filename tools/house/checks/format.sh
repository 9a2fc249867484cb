#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Checks that every C++ file is formatted by clang-format 14. Other versions format differently and are not used.
set -eu
cd "$(dirname "$0")/../../.."
if ! clang-format --version 2>/dev/null | grep -q 'version 14\.'; then
  echo "format: skipped, clang-format 14 not found"
  exit 0
fi
unformatted=$(tools/house/tracked .h .cpp | xargs -d '\n' clang-format --dry-run 2>&1 |
  sed -nE 's/^([^ :]+):[0-9]+:[0-9]+: warning: code should be clang-formatted.*/\1/p' | uniq)
[ -z "$unformatted" ] || { echo "not formatted (run clang-format -i):"; echo "$unformatted"; exit 1; }
