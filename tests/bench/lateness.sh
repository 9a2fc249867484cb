#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# How late a task of 1 ms begins under load, beside a bare loop of clock_nanosleep: five runs of each in turn, their
# 99.9th percentiles and the medians of them.
#   tests/bench/lateness.sh [SECONDS]      of each run; default 60
set -eu
seconds=${1:-60}
here=$(cd "$(dirname "$0")" && pwd)
. "$here/one_task.sh"
trap 'kill $(cat "$folder"/load) 2>/dev/null; rm -rf "$folder"' EXIT
# The load: a busy process on each CPU, and one that moves memory.
for _ in $(seq "$(nproc)"); do
  sh -c 'while :; do :; done' &
  echo $! >> "$folder/load"
done
dd if=/dev/zero of=/dev/null bs=64M 2>/dev/null &
echo $! >> "$folder/load"
for run in 1 2 3 4 5; do
  "$folder/bare" "$seconds" >> "$folder/bare.us"
  "$folder/app" --realtime --for "${seconds}s" --watch p.n > "$folder/out" 2> "$folder/note"
  sed -n 's/.*99.9 % below \([0-9.]*\) us.*/\1/p' "$folder/out" >> "$folder/app.us"
  echo "run $run: bare $(tail -1 "$folder/bare.us") us, task $(tail -1 "$folder/app.us") us"
done
grep note "$folder/note" || true
grep '^task' "$folder/out"
echo "median: bare $(sort -n "$folder/bare.us" | sed -n 3p) us, task $(sort -n "$folder/app.us" | sed -n 3p) us (99.9 % of the starts)"
