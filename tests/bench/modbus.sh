#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Requests per second of a Modbus TCP server, with masters that ask as fast as they get replies: the block ModbusTCP_Slave
# in a compiled program with a task of 10 ms, beside a server in C with libmodbus. Five runs of each in turn; processor
# time of the server for a thousand requests, and the median ratio. Needs libmodbus-dev.
#   tests/bench/modbus.sh [SECONDS [MASTERS]]      of each run; default 3, 100
set -eu
seconds=${1:-3} masters=${2:-100}
top=$(cd "$(dirname "$0")/../.." && pwd)
rung=${RUNG:-$top/build/bin/rung}
folder=$(mktemp -d)
server=
trap '[ -z "$server" ] || kill $server 2>/dev/null; rm -rf "$folder"' EXIT
cd "$folder"
gcc -O2 "$top/tests/programs/comm/flood.c" -o flood
gcc -O2 -I /usr/include/modbus "$top/tests/bench/modbus_reference.c" -lmodbus -o reference
cat > slave.st <<'END'
PROGRAM Main
VAR tcp : ModbusTCP_Slave; port : DINT; q3 AT %QW3 : WORD; END_VAR
q3 := 16#1234;
tcp(Enable := TRUE, Port := port, Unit := 1);
END_PROGRAM
CONFIGURATION c RESOURCE r ON PLC TASK t(INTERVAL := T#10ms, PRIORITY := 1); PROGRAM Main WITH t : Main; END_RESOURCE END_CONFIGURATION
END
"$rung" build slave.st -Wno-all -o slave
free_port() { python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])'; }
ticks=$(getconf CLK_TCK)

# Runs the server "$@" and prints requests per second and CPU microseconds per request.
measure() {
  local name=$1 port before after rate
  port=$2
  shift 2
  "$@" > server.log 2>&1 &
  server=$!
  ./flood "$port" 0.2 1 0 > /dev/null   # it listens
  before=$(awk '{ print $14 + $15 }' "/proc/$server/stat")
  rate=$(./flood "$port" "$seconds" "$masters" 0 | awk '/per second/ { print $4 }')
  after=$(awk '{ print $14 + $15 }' "/proc/$server/stat")
  kill $server
  wait $server 2>/dev/null || true
  grep -o '[0-9]* overruns' server.log >> overruns.txt || true
  server=
  echo "$rate $(awk -v t=$((after - before)) -v hz="$ticks" -v r="$rate" -v s="$seconds" 'BEGIN { printf "%.2f", t / hz * 1e6 / (r * s) }')" | tee -a "$name.txt"
}
for run in 1 2 3 4 5; do
  port=$(free_port)
  echo "run $run: rung $(measure rung "$port" ./slave --realtime --for 60s --set "Main.port=$port" --watch Main.tcp.Error), libmodbus $(port=$(free_port); measure libmodbus "$port" ./reference "$port")"
done
echo "dropped starts of the task: $(tr '\n' ' ' < overruns.txt)"
median() { cut -d' ' -f"$2" "$1.txt" | sort -n | sed -n 3p; }
awk -v a="$(median rung 1)" -v b="$(median libmodbus 1)" -v c="$(median rung 2)" -v d="$(median libmodbus 2)" 'BEGIN {
  printf "median: rung %d requests per second, libmodbus %d, ratio %.2f; processor time of the server %.1f and %.1f us per request, ratio %.2f\n", a, b, a / b, c, d, c / d }'
