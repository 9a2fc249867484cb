#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Runs clang-tidy on the project's own sources, or on the files given; no output means clean.
#   tools/clang_tidy.sh [FILE.cpp...]      needs a configured build folder (BUILD=build)
set -eu
cd "$(dirname "$0")/.."
build=${BUILD:-build}
[ -f "$build/compile_commands.json" ] || cmake --preset release >/dev/null
if [ $# -gt 0 ]; then
  files=("$@")
else
  mapfile -t files < <(tools/house/tracked .cpp | grep -vE '^tests/(unit|fuzz|bench|programs)/')
fi
# clang cannot read the precompiled header of g++; the files include what they use without it.
database=$(mktemp -d)
trap 'rm -rf "$database"' EXIT
sed -E 's/-Winvalid-pch -include [^ "]*cmake_pch\.hxx//' "$build/compile_commands.json" >"$database/compile_commands.json"
printf '%s\0' "${files[@]}" | xargs -0 -n 4 -P "$(nproc)" clang-tidy --quiet -p "$database" 2> >(grep -v 'warnings generated' >&2)
