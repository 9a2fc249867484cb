#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The CPU time of rung/monitor.h in compiled programs, and what forces cost a cycle.
#   tests/bench/monitor.sh
# find     a path of three parts in a program of 5 000 variables: at most 200 ns
# read     a value by its handle: below 20 ns
# list     100 000 symbols with their paths and types: at most 50 ms
# force    a row of the table, applied
# cycle    instructions of one cycle of `rung run` without forces, by callgrind (where valgrind is installed)
# RUNG names the tool (build/bin/rung), CC the compiler (gcc). A bound that does not hold: exit code 1.
set -eu
cd "$(dirname "$0")/../.."
rung=$(readlink -f "${RUNG:-build/bin/rung}")
[ -x "$rung" ] || { echo "$rung not found; build first (cmake --preset release && cmake --build build)" >&2; exit 2; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# COUNT variables, half of them global and half in the program.
program() {
  echo 'TYPE Pump : STRUCT on : BOOL; level : REAL; speed : INT; END_STRUCT END_TYPE VAR_GLOBAL'
  seq "$(($1 / 2))" | sed 's/.*/  g_variable_& : DINT;/'
  echo 'END_VAR PROGRAM Main VAR pumps : ARRAY[1..10] OF Pump;'
  seq "$(($1 / 2))" | sed 's/.*/  variable_& : DINT;/'
  echo 'END_VAR variable_1 := variable_1 + 1; END_PROGRAM'
  echo 'CONFIGURATION Plant RESOURCE Cpu ON PLC TASK t(INTERVAL := T#10ms, PRIORITY := 1); PROGRAM Main WITH t : Main; END_RESOURCE END_CONFIGURATION'
}

for count in 5000 100000; do
  program "$count" >"$work/$count.st"
  "$rung" build "$work/$count.st" -Wno-all --shared --name "p$count" -o "$work/p$count.so"
done
${CC:-gcc} -std=gnu11 -O2 -Wall -Wextra -I stdlib/runtime/include tests/bench/monitor.c \
  "$(dirname "$(dirname "$rung")")/lib/librung_runtime.a" -ldl -lm -o "$work/monitor"
"$work/monitor" "$work/p5000.so" p5000_module "$work/p100000.so" p100000_module

command -v valgrind >/dev/null || exit 0
instructions() {  # cycles
  valgrind --tool=callgrind --callgrind-out-file=/dev/null "$rung" run "$work/5000.st" -Wno-all --cycles "$1" --watch Main.variable_1 2>&1 |
    awk '/Collected/ { print $4 }'
}
echo "cycle: $((($(instructions 21000) - $(instructions 1000)) / 20000)) instructions"
