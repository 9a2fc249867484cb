#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# How fast a program runs under the debugger, as a part of the speed of `rung run`: without breakpoints (at least 0.8), with
# a line breakpoint elsewhere (0.7), with a watched variable that does not change (0.3). CPU seconds, the best of five in turn.
#   tests/bench/debugger.sh [CYCLES]
set -eu
cd "$(dirname "$0")/../.."
rung=$(readlink -f "${RUNG:-build/bin/rung}")
cycles=${1:-300000}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cat >"$work/main.st" <<'END'
PROGRAM Main
VAR i, j : DINT; sum : LINT; a : ARRAY[0..99] OF DINT; x : REAL; flag : BOOL; never : INT; END_VAR
FOR i := 0 TO 99 DO
  a[i] := a[i] + i;
  IF a[i] > 1000 THEN
    a[i] := a[i] - 1000;
    flag := NOT flag;
  END_IF
  sum := sum + a[i];
  x := x * 0.99 + DINT_TO_REAL(i);
END_FOR
j := 0;
WHILE j < 100 DO
  j := j + 1;
  sum := sum XOR j;
END_WHILE
IF j < 0 THEN
  never := 1;
END_IF
END_PROGRAM
END
cd "$work"
common=(main.st --cycles "$cycles" --watch Main.sum)
measure() {  # NAME COMMAND...
  local name=$1
  shift
  local seconds
  seconds=$({ TIMEFORMAT=%U; time "$@" >/dev/null; } 2>&1)
  echo "$name $seconds" >>times
}
for _ in 1 2 3 4 5; do
  measure run "$rung" run "${common[@]}" --engine=interp
  measure debug "$rung" debug "${common[@]}" --batch -c run
  measure line "$rung" debug "${common[@]}" --batch -c 'break 18' -c run
  measure data "$rung" debug "${common[@]}" --batch -c 'watch Main.never' -c run
done
awk '{ if (!($1 in best) || $2 < best[$1]) best[$1] = $2 }
     END { printf "run %.2f s; of its speed: debug %.2f, line breakpoint %.2f, watched variable %.2f\n",
           best["run"], best["run"] / best["debug"], best["run"] / best["line"], best["run"] / best["data"] }' times
