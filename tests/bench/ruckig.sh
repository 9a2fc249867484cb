#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Motion profiles beside Ruckig's (github.com/pantor/ruckig), which is built and installed beside the project and never in it:
# a million seeded random requests of one axis with target acceleration 0. Exit code 1 when one of ours takes longer than
# 1 + 1e-9 times Ruckig's time, misses its target or breaks a limit that Ruckig's keeps, or when ours cost more than 1.1
# times the time of Ruckig's or 10 us at worst.
#   tests/bench/ruckig.sh FOLDER [COUNT [SEED]]
# FOLDER has include/ruckig and the library (in lib/, build/ or itself). CXX names the compiler (g++).
set -eu
cd "$(dirname "$0")/../.."
[ $# -ge 1 ] || { sed -n '2,8s/^# \{0,1\}//p' "$0" >&2; exit 2; }
folder=$1
shift
library=$(find "$folder" -maxdepth 2 \( -name 'libruckig.a' -o -name 'libruckig.so' \) 2>/dev/null | sort | head -n 1)
[ -d "$folder/include/ruckig" ] && [ -n "$library" ] || { echo "$folder: no include/ruckig, or no library; build Ruckig first" >&2; exit 2; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cxx=${CXX:-g++}
# As rung_runtime is compiled.
for source in stdlib/motion/profile/*.cpp; do
  "$cxx" -std=c++17 -O2 -DNDEBUG -Wall -Wextra -ffp-contract=off -fno-exceptions -fno-rtti -c "$source" -o "$work/$(basename "$source").o"
done
"$cxx" -std=c++20 -O2 -DNDEBUG -Wall -Wextra -I stdlib/motion/profile -I "$folder/include" tests/bench/ruckig.cpp \
  "$work"/*.o "$library" -Wl,-rpath,"$(dirname "$(readlink -f "$library")")" -o "$work/ruckig"
"$work/ruckig" "$@"
