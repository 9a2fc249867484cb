# SPDX-License-Identifier: Apache-2.0
# Sourced by lateness.sh and overhead.sh: $folder with `app`, a program with a task of 1 ms and nearly no code, and
# `bare`, the loop of clock_nanosleep that it is compared with.
rung=${RUNG:-$here/../../build/bin/rung}
folder=$(mktemp -d)
gcc -O2 "$here/lateness.c" -o "$folder/bare"
cat > "$folder/main.st" <<'END'
PROGRAM Main
VAR n AT %QW0 : UINT; in AT %IW0 : UINT; END_VAR
n := n + in + 1;
END_PROGRAM
CONFIGURATION c
RESOURCE r ON PLC
TASK t(INTERVAL := T#1ms, PRIORITY := 1);
PROGRAM p WITH t : Main;
END_RESOURCE
END_CONFIGURATION
END
"$rung" build "$folder/main.st" -o "$folder/app"
