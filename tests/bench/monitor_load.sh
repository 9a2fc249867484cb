#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# What the monitor of a running program costs.
#   tests/bench/monitor_load.sh [SECONDS]      of each run of the first part; default 60
# lateness   of a task of 1 ms with 1000 variables in real time, without a client and with one that takes 1000 values at
#            the full rate and asks for others as fast as it gets answers: five runs of each in turn, the medians of the
#            99.9th percentiles; with a client at most 1.2 times as late
# symbols    100 000 listed in one answer: at most 50 ms
# cycle      instructions of one cycle of `rung run` without a monitor, and with one without a client, by callgrind (where
#            valgrind is installed)
# RUNG names the tool (build/bin/rung). A bound that does not hold: exit code 1.
set -eu
seconds=${1:-60}
cd "$(dirname "$0")/../.."
rung=$(readlink -f "${RUNG:-build/bin/rung}")
[ -x "$rung" ] || { echo "$rung not found; build first (cmake --preset release && cmake --build build)" >&2; exit 2; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0

# A program of COUNT variables, of which one counts.
program() {
  echo "PROGRAM Main VAR n : DINT; a : ARRAY[1..$1] OF DINT; i : INT; END_VAR"
  echo "n := n + 1; FOR i := 1 TO 100 DO a[i] := n; END_FOR END_PROGRAM"
  echo 'CONFIGURATION c RESOURCE r ON PLC TASK t(INTERVAL := T#1ms, PRIORITY := 1); PROGRAM Main WITH t : Main; END_RESOURCE END_CONFIGURATION'
}

program 1000 >"$work/load.st"
"$rung" build "$work/load.st" -Wno-all -o "$work/app"
percentile() { sed -n 's/.*99.9 % below \([0-9.]*\) us.*/\1/p' "$work/out"; }
median() { sort -n "$1" | sed -n 3p; }
for run in 1 2 3 4 5; do
  "$work/app" --realtime --monitor 0 --for "${seconds}s" --watch Main.n >"$work/out" 2>"$work/err"
  percentile >>"$work/alone"
  tests/monitor/load.py "$work/app" --realtime --for "${seconds}s" --watch Main.n >"$work/out"
  percentile >>"$work/asked"
  echo "run $run: alone $(tail -1 "$work/alone") us, with a client $(tail -1 "$work/asked") us; $(tail -1 "$work/out")"
done
grep note "$work/err" || true
awk -v alone="$(median "$work/alone")" -v asked="$(median "$work/asked")" 'BEGIN {
  printf "lateness: alone %s us, with a client %s us: %.2f times (at most 1.2)\n", alone, asked, asked / alone
  exit asked / alone > 1.2 }' || failed=1

program 100000 >"$work/symbols.st"
tests/monitor/load.py --symbols "$rung" run "$work/symbols.st" -Wno-all --watch Main.n || failed=1

command -v valgrind >/dev/null || exit $failed
instructions() {  # CYCLES OPTION ...
  valgrind --tool=callgrind --callgrind-out-file="$work/callgrind" "$rung" run "$work/load.st" -Wno-all --cycles "$1" --watch Main.n "${@:2}" 2>&1 |
    awk '/Collected/ { print $4 }'
}
cost() { echo $((($(instructions 21000 "$@") - $(instructions 1000 "$@")) / 20000)); }
sed -i 's/T#1ms/T#1us/' "$work/load.st"  # faster than any machine, so nothing is waited for
echo "cycle: $(cost) instructions without a monitor, $(cost --monitor 0) with one without a client"
exit $failed
