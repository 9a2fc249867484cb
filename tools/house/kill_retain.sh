#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Kills a program that writes retained data all the time, at random moments, and looks at what the next start finds: the
# values of one complete cycle, never older than before. Called by tools/long.sh.
#   tools/house/kill_retain.sh [COUNT] [SEED]
set -eu
count=${1:-200}
seed=${2:-1}
here=$(cd "$(dirname "$0")/../.." && pwd)
rung=${RUNG:-$here/build/bin/rung}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cat > "$folder/main.st" <<'END'
PROGRAM Main
VAR RETAIN first : UDINT; words : ARRAY[1..2000] OF UDINT; last : UDINT; END_VAR
VAR i : INT; torn : UDINT; END_VAR
IF words[1] <> first OR words[2000] <> first OR last <> first THEN torn := torn + 1; END_IF
first := first + 1;
FOR i := 1 TO 2000 DO words[i] := first; END_FOR
last := first;
END_PROGRAM
END
"$rung" build "$folder/main.st" -o "$folder/app"
cd "$folder"
awk -v n="$count" -v seed="$seed" 'BEGIN { srand(seed); for (i = 0; i < n; i++) printf "%.4f\n", 0.005 + 0.03 * rand() }' > delays
before=0 failed=0 advanced=0
while read -r delay; do
  ./app --realtime --interval 200us --retain kept --retain-interval 100us > out 2>&1 &
  pid=$!
  sleep "$delay"
  kill -KILL $pid
  wait $pid 2>/dev/null || true
  # One cycle compares what was restored.
  ./app --cycles 1 --retain kept --watch Main.first,Main.torn > found 2>&1 || { cat found; failed=$((failed + 1)); }
  first=$(sed -n 's/^Main.first = //p' found)
  torn=$(sed -n 's/^Main.torn = //p' found)
  if [ "${torn:-x}" != 0 ] || [ "$first" -le "$before" ] || grep -q damaged found; then
    echo "wrong after $delay s: first $first, before $before"
    cat found
    failed=$((failed + 1))
  fi
  [ "$first" -gt $((before + 1)) ] && advanced=$((advanced + 1))
  before=$first
done < delays
echo "$count kills, $advanced of them after a new state had been written, $failed wrong"
[ "$failed" = 0 ]
