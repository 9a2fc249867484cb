#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The CPU time of 10 000 timers in one cycle, compiled as `rung build` ships them.
#   tests/bench/timers.sh [LIMIT]      microseconds that no median may exceed (100)
# loop      an array of TON, of which a quarter idles, a quarter times, a quarter has expired and a quarter changes
# changing  each IN changes at random, in one of four cycles
# named     a hundred blocks of a hundred TON with names of their own, each called with its own variables
# RUNG names the tool (build/bin/rung), CC the compiler (gcc).
set -eu
cd "$(dirname "$0")/../.."
rung=$(readlink -f "${RUNG:-build/bin/rung}")
[ -x "$rung" ] || { echo "$rung not found; build first (cmake --preset release && cmake --build build)" >&2; exit 2; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

program() {
  cat <<'ST'
VAR_GLOBAL
  levels : ARRAY[0..9999] OF BOOL;
  expired : DINT;
END_VAR

PROGRAM Quarters
VAR i : DINT; cycle : UDINT; END_VAR
FOR i := 0 TO 2499 DO levels[i] := FALSE; END_FOR
FOR i := 2500 TO 7499 DO levels[i] := TRUE; END_FOR
FOR i := 7500 TO 9999 DO levels[i] := (cycle + DINT_TO_UDINT(i)) MOD 8 < 4; END_FOR
cycle := cycle + 1;
END_PROGRAM

PROGRAM Random
VAR i : DINT; random : UDINT := 4711; END_VAR
FOR i := 0 TO 9999 DO
  random := random * 1664525 + 1013904223;
  IF random / 65536 MOD 4 = 0 THEN levels[i] := NOT levels[i]; END_IF
END_FOR
END_PROGRAM

PROGRAM Timers
VAR timers : ARRAY[0..9999] OF TON; i : DINT; count : DINT; END_VAR
count := 0;
FOR i := 0 TO 4999 DO
  timers[i](IN := levels[i], PT := T#49d);
  count := count + BOOL_TO_DINT(timers[i].Q);
END_FOR
FOR i := 5000 TO 9999 DO
  timers[i](IN := levels[i], PT := T#20ms);
  count := count + BOOL_TO_DINT(timers[i].Q);
END_FOR
expired := count;
END_PROGRAM

FUNCTION_BLOCK Group
VAR_INPUT first : DINT; END_VAR
VAR_OUTPUT count : DINT; END_VAR
ST
  local n
  echo "VAR"
  for n in $(seq 0 99); do echo "  delay$n : TON;"; done
  echo "END_VAR"
  echo "count := 0;"
  for n in $(seq 0 99); do
    echo "delay$n(IN := levels[first + $n], PT := T#${n}0ms);"
    echo "count := count + BOOL_TO_DINT(delay$n.Q);"
  done
  cat <<'ST'
END_FUNCTION_BLOCK

PROGRAM Groups
VAR groups : ARRAY[0..99] OF Group; i : DINT; END_VAR
FOR i := 0 TO 99 DO groups[i](first := i * 100); END_FOR
END_PROGRAM

CONFIGURATION Bench RESOURCE Host ON PLC
TASK T_loop(INTERVAL := T#10ms, PRIORITY := 1);
TASK S_loop(INTERVAL := T#10ms, PRIORITY := 1);
TASK T_changing(INTERVAL := T#10ms, PRIORITY := 1);
TASK S_changing(INTERVAL := T#10ms, PRIORITY := 1);
TASK T_named(INTERVAL := T#10ms, PRIORITY := 1);
TASK S_named(INTERVAL := T#10ms, PRIORITY := 1);
PROGRAM a WITH T_loop : Timers;
PROGRAM b WITH S_loop : Quarters;
PROGRAM c WITH T_changing : Timers;
PROGRAM d WITH S_changing : Random;
PROGRAM e WITH T_named : Groups;
PROGRAM f WITH S_named : Quarters;
END_RESOURCE END_CONFIGURATION
ST
}

program >"$work/timers.st"
"$rung" build "$work/timers.st" --shared -o "$work/timers.so" 2>"$work/messages" || { cat "$work/messages" >&2; exit 2; }
${CC:-gcc} -std=c11 -O2 -Wall -Wextra -I stdlib/runtime/include tests/bench/timers.c \
  "$(dirname "$(dirname "$rung")")/lib/librung_runtime.a" -ldl -lm -o "$work/timers"
"$work/timers" "$work/timers.so" "${1:-100}"
