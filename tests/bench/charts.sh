#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The cost of a chart's cycle: with 2 steps and with 1000, one of them active. The second may cost more only by the scan
# of 16 words. Usage: tests/bench/charts.sh [RUNG]
rung=${1:-build/bin/rung}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

for steps in 2 1000; do
  awk -v n=$steps 'BEGIN {
    print "FUNCTION_BLOCK Chart\nVAR_INPUT go : BOOL; END_VAR\nVAR_OUTPUT c : UDINT; END_VAR"
    for (i = 0; i < n; i++) {
      printf "%s s%d: Work(N); END_STEP\n", i == 0 ? "INITIAL_STEP" : "STEP", i
      printf "TRANSITION FROM s%d TO s%d := go AND s%d.T > T#1h; END_TRANSITION\n", i, (i + 1) % n, i
    }
    print "ACTION Work: c := c + 1; END_ACTION\nEND_FUNCTION_BLOCK"
    print "PROGRAM Main\nVAR f : Chart; i : DINT; END_VAR"
    print "FOR i := 1 TO 100000 DO f(go := TRUE); END_FOR\nEND_PROGRAM"
  }' >"$folder/$steps.st"
  for cycles in 1 101; do
    "$rung" run --engine=native --cycles=$cycles --watch=Main.i --trace="$folder/trace" "$folder/$steps.st"  # compiled once
    begin=$(date +%s%N)
    "$rung" run --engine=native --cycles=$cycles --watch=Main.i --trace="$folder/trace" "$folder/$steps.st"
    end=$(date +%s%N)
    [ $cycles = 1 ] && base=$((end - begin))
  done
  echo "$steps steps: $(((end - begin - base) / 10000000)) ns a cycle"
done
