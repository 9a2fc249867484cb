#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# What changes of a running program cost it: a task of 1 ms, in real time, is changed again and again, so that all of
# its memory moves; no start may be lost. On a quiet machine: with other work on all cores the system decides.
#   tests/bench/online_change.sh [CHANGES]     of each engine and size; default 10
# RUNG names the tool (build/bin/rung). A start that was lost: exit code 1.
set -eu
changes=${1:-10}
cd "$(dirname "$0")/../.."
rung=$(readlink -f "${RUNG:-build/bin/rung}")
[ -x "$rung" ] || { echo "$rung not found; build first (cmake --preset release && cmake --build build)" >&2; exit 2; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0

program() {  # VARIABLES DECLARATION
  echo "FUNCTION_BLOCK Part VAR_INPUT x : DINT; END_VAR VAR $2 t : TON; sum : LREAL; END_VAR t(IN := TRUE, PT := T#1h); sum := sum + x; END_FUNCTION_BLOCK"
  echo "PROGRAM Main VAR $2 n : DINT; parts : ARRAY[1..$1] OF Part; i : INT; END_VAR"
  echo "n := n + 1; FOR i := 1 TO 100 DO parts[i](x := n); END_FOR END_PROGRAM"
  echo 'CONFIGURATION c RESOURCE r ON PLC TASK t(INTERVAL := T#1ms, PRIORITY := 1); PROGRAM Main WITH t : Main; END_RESOURCE END_CONFIGURATION'
}

for parts in 100 10000; do
  mkdir -p "$work/one" "$work/two"
  program $parts "" >"$work/one/main.st"
  program $parts "first : LREAL;" >"$work/two/main.st"
  for engine in interp native; do
    rm -f "$work/commands"
    mkfifo "$work/commands"
    {
      sleep 1
      for ((i = 0; i < changes; ++i)); do
        if ((i % 2 == 0)); then echo "change $work/two"; else echo "change $work/one"; fi
        sleep 2
      done
      echo quit
    } >"$work/commands" &
    "$rung" run "$work/one" -Wno-all --engine=$engine --realtime --control "$work/commands" --watch Main.n >"$work/out" 2>&1
    wait
    made=$(grep -c ' their values' "$work/out" || true)
    lost=$(sed -n 's/.* \([0-9]*\) overruns.*/\1/p' "$work/out")
    late=$(sed -n 's/.*started up to \([0-9.]*\) us late.*/\1/p' "$work/out")
    echo "$parts blocks, $engine: $made changes, $lost starts lost, at most $late us late"
    [ "$made" = "$changes" ] && [ "$lost" = 0 ] || failed=1
  done
done
exit $failed
