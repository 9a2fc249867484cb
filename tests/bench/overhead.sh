#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# What the host's schedule costs a cycle: processor time of a program with a task of 1 ms and nearly no code, less that of a
# bare loop of clock_nanosleep (lateness.c), per cycle; five runs of each in turn, the median. Wanted: below 2 us.
#   tests/bench/overhead.sh [SECONDS]      of each run; default 10
set -eu
seconds=${1:-10}
here=$(cd "$(dirname "$0")" && pwd)
. "$here/one_task.sh"
trap 'rm -rf "$folder"' EXIT
# User and system time of a run in ns.
TIMEFORMAT='%3U %3S'
spent() {
  { time "$@" >/dev/null 2>/dev/null; } 2>&1 | awk '{ printf "%.0f\n", ($1 + $2) * 1e9 }'
}
# Per cycle: a run less one of a second, which has the same beginning and end.
cycles=$((seconds * 1000))
bare() { echo $((($(spent "$folder/bare" $((seconds + 1))) - $(spent "$folder/bare" 1)) / cycles)); }
task() {
  local app=("$folder/app" --realtime --for)
  echo $((($(spent "${app[@]}" $((seconds + 1))s) - $(spent "${app[@]}" 1s)) / cycles))
}
for run in 1 2 3 4 5; do
  bare=$(bare)
  task=$(task)
  echo "run $run: bare $bare ns, task $task ns a cycle"
  echo $((task - bare)) >> "$folder/differences"
done
echo "overhead, median: $(sort -n "$folder/differences" | sed -n 3p) ns a cycle"
