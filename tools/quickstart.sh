#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# From a fresh clone to a running program: installs packages, builds the compiler, runs a sample and shows its trace.
set -eu
cd "$(dirname "$0")/.."
tools/install-packages.sh
echo "building (a minute or two)"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
# A unity build takes half the time of a build for developers; tools/test.sh keeps the setting. Fitting cams needs
# packages that nothing else needs; tools/test.sh installs them.
settings=()
[ -e build/CMakeCache.txt ] || settings=(-DCMAKE_UNITY_BUILD=ON -DRUNG_CAM_FIT=OFF)
{ cmake --preset release "${settings[@]}" && cmake --build build --target rung; } >"$log" 2>&1 || { tail -40 "$log"; exit 1; }

command=(build/bin/rung run samples/conveyor --inputs samples/conveyor/shift.csv --cycles 21
  --watch Main.start,Main.part,Main.motor,Main.horn,Main.belt.state,Main.belt.parts --trace -)
echo "\$ ${command[*]}"
"${command[@]}"
