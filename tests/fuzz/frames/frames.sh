#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Frames that peers send, under libFuzzer with ASan and UBSan: the servers of the bundled host, and a program with the blocks
# of masters and of the freeport (frames.cpp). Needs clang++. An input that fails is left in the current folder.
#   tests/fuzz/frames/frames.sh [SECONDS [SEED]]      default 60, 1
set -eu
seconds=${1:-60} seed=${2:-1}
top=$(cd "$(dirname "$0")/../../.." && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
runtime=$top/stdlib/runtime
"$top/build/bin/rung" emit "$top/tests/fuzz/frames/plant.iecst" --name plant -Wno-all -o "$folder/plant" > /dev/null
clang++ -std=c++17 -O1 -g -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=undefined -I "$runtime/include" -I "$runtime/host" -I "$folder/plant" \
  "$top/tests/fuzz/frames/frames.cpp" "$folder"/plant/*.cpp "$runtime"/host/{modbus_server,served_image,sockets}.cpp "$runtime/src/modbus.cpp" \
  "$top/build/lib/librung_runtime.a" -lpthread -o "$folder/frames"
mkdir "$folder/corpus"
"$folder/frames" -max_total_time="$seconds" -max_len=600 -seed="$seed" -verbosity=0 -print_final_stats=1 "$folder/corpus" 2>&1 |
  tee "$folder/out" | grep -E 'ERROR|SUMMARY|runtime error' || true
grep -q 'stat::number_of_executed_units' "$folder/out" && ! grep -q 'SUMMARY' "$folder/out" || { tail -40 "$folder/out"; exit 1; }
sed -n 's/stat::number_of_executed_units: */inputs: /p' "$folder/out"
