#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Processor time of one axis in a cycle: 1 000 axes in a task of 1 ms, each with MC_Power and a motion block, in a
# compiled program. Virtual axes and simulated drives; steady motion, and moves that end and begin again all the time.
# The same program without axes is taken off. Half of the 1 ms is 500 ns for an axis: exit code 1 when one needs more.
#   tests/bench/axes.sh [CYCLES]      default 5000
set -eu
cycles=${1:-5000}
top=$(cd "$(dirname "$0")/../.." && pwd)
rung=${RUNG:-$top/build/bin/rung}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
# program NAME VIRTUAL MOTION: MOTION uses axes[i], i and k.
program() {
  cat > "$1.st" <<END
VAR_GLOBAL axes : ARRAY[1..1000] OF AXIS_REF_SM3; END_VAR
PROGRAM Main
VAR power : ARRAY[1..1000] OF MC_Power; go : ARRAY[1..1000] OF MC_MoveVelocity; move : ARRAY[1..1000] OF MC_MoveAbsolute;
  i : INT; k : DINT; END_VAR
k := k + 1;
FOR i := 1 TO 1000 DO
  IF k = 1 THEN axes[i].bVirtual := $2; END_IF
  $3
END_FOR
END_PROGRAM
CONFIGURATION c RESOURCE r ON PLC TASK t(INTERVAL := T#1ms, PRIORITY := 1); PROGRAM Main WITH t : Main; END_RESOURCE END_CONFIGURATION
END
  "$rung" build "$1.st" -Wno-all -o "$1"
}
power='power[i](Axis := axes[i], Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);'
steady='go[i](Axis := axes[i], Execute := power[i].Status, Velocity := 10, Acceleration := 500, Deceleration := 500, Jerk := 5000, Direction := MC_Direction#positive);'
short='move[i](Axis := axes[i], Execute := power[i].Status AND NOT move[i].Done, Position := (k / 10 + i) MOD 7, Velocity := 100, Acceleration := 5000, Deceleration := 5000, Jerk := 500000);'
program none TRUE ''
sed -i 's/ AXIS_REF_SM3/ INT/; s/axes\[i\].bVirtual := TRUE/axes[i] := 1/; s/power :.*OF MC_MoveAbsolute;//' none.st
"$rung" build none.st -Wno-all -o none
program virtual TRUE "$power $steady"
program drive FALSE "$power $steady"
program moves TRUE "$power $short"
cpu() { ( TIMEFORMAT='%U'; time "./$1" --cycles "$cycles" > /dev/null ) 2>&1; }
printf 'ns of one axis in one cycle, the lowest of three runs:\n'
failed=0
for name in virtual drive moves; do
  for _ in 1 2 3; do echo "$(cpu "$name") $(cpu none)"; done | awk -v n="$cycles" -v name="$name" '
    { t = ($1 - $2) / n / 1000 * 1e9; if (NR == 1 || t < best) best = t }
    END { printf "%-8s %6.0f\n", name, best; exit best > 500 }' || failed=1
done
exit $failed
