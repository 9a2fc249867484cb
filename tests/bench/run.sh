#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# All benchmarks, as figures and ratios measured in one run.
#   tests/bench/run.sh [--input FILE.st]... [--kernels DIR] [compiler|cxx|start|kernels|interp]...
# compiler  lines per second of each phase for about 1 000, 10 000 and 100 000 generated lines, and for each --input
# cxx       CPU seconds of the C++ compiler at -O2 for the output of 100 000 lines (and of each --input)
# start     wall milliseconds of `rung check` for a program of 20 lines
# kernels   the shared library of `rung build` against hand-written C++ at -O2, in CPU time and in turn; --kernels names
#           a folder with another kernels.st (blocks K_NAME with rounds and check) and hand.cpp, which is measured too
# interp    the interpreter as multiples of native code at -O2, on the same kernels
# RUNG names the tool (build/bin/rung), CXX the compiler (g++).
set -eu
cd "$(dirname "$0")/../.."
root=$PWD
rung=$(readlink -f "${RUNG:-build/bin/rung}")
cxx=${CXX:-g++}
include=$root/stdlib/runtime/include
[ -x "$rung" ] || { echo "$rung not found; build first (cmake --preset release && cmake --build build)" >&2; exit 2; }
runtime=$(dirname "$(dirname "$rung")")/lib/librung_runtime.a

inputs=() parts=() other_kernels=
while [ $# -gt 0 ]; do
  case $1 in
    --input) inputs+=("$(readlink -f "$2")"); shift 2 ;;
    --kernels) other_kernels=$(readlink -f "$2"); shift 2 ;;
    compiler|cxx|start|kernels|interp) parts+=("$1"); shift ;;
    *) sed -n '2,12s/^# \{0,1\}//p' "$0"; exit 2 ;;
  esac
done
[ ${#parts[@]} -gt 0 ] || parts=(compiler cxx start kernels interp)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
$cxx -std=c++17 -O2 tests/bench/generate.cpp -o "$work/generate"
for lines in 1000 10000 100000; do "$work/generate" "$lines" >"$work/$lines.st"; done

compiler() {
  echo "== compiler: rung emit -O1"
  for file in "$work"/{1000,10000,100000}.st "${inputs[@]}"; do
    echo "-- $(basename "$file"), $(wc -l <"$file") lines"
    # The second of two runs: the first loads the tool and the input into memory.
    "$rung" emit "$file" -o "$work/out" 2>/dev/null || true
    rm -rf "$work/out"
    "$rung" emit --time-phases "$file" -o "$work/out" || echo "failed with exit code $?"
    rm -rf "$work/out"
  done
}

cxx_seconds() {  # folder
  local files=("$1"/*.cpp)
  ( TIMEFORMAT='%U %S'; time for file in "${files[@]}"; do
      $cxx -std=c++17 -O2 -ffp-contract=off -I "$include" -c "$file" -o "$work/x.o"
    done ) 2>&1 | awk -v files="${#files[@]}" 'NF == 2 { printf "%.2f CPU s for %d files\n", $1 + $2, files; next } { print }'
}

cxx() {
  echo "== C++ compiler: $cxx -O2 on the output"
  for file in "$work/100000.st" "${inputs[@]}"; do
    rm -rf "$work/out"
    "$rung" emit "$file" -o "$work/out" || { echo "failed with exit code $?"; continue; }
    echo "-- $(basename "$file"): $(cat "$work"/out/*.cpp "$work"/out/*.h | wc -l) lines of C++, $(cxx_seconds "$work/out")"
  done
}

start() {
  echo "== start: rung check of 20 lines"
  cat >"$work/small.st" <<'ST'
FUNCTION_BLOCK Lamp
VAR_INPUT button : BOOL; END_VAR
VAR_OUTPUT on : BOOL; END_VAR
VAR
  edge : R_TRIG;
  off : TON;
END_VAR
edge(CLK := button);
IF edge.Q THEN on := NOT on; END_IF;
off(IN := on, PT := T#10s);
IF off.Q THEN on := FALSE; END_IF;
END_FUNCTION_BLOCK

PROGRAM Main
VAR
  hall : Lamp;
  press : BOOL;
END_VAR
hall(button := press);
END_PROGRAM
ST
  for _ in $(seq 21); do
    local begin=${EPOCHREALTIME/[.,]/}
    "$rung" check "$work/small.st" || { echo "failed with exit code $?"; return; }
    echo $((${EPOCHREALTIME/[.,]/} - begin))
  done | sort -n | awk '{ t[NR] = $1 } END { printf "%.1f ms best, %.1f ms median of %d\n", t[1] / 1000, t[int((NR + 1) / 2)] / 1000, NR }'
}

# Wraps a file of blocks K_NAME in the common form (program NAME, task T_NAME, instance P_NAME).
wrap() {
  sed '/^PROGRAM /,$d' "$1/kernels.st"
  local names=(pid sort matmul string case calls) name
  for name in "${names[@]}"; do
    echo "PROGRAM W_$name VAR_INPUT rounds : DINT; END_VAR VAR_OUTPUT check : DINT; END_VAR VAR k : K_${name^^}; END_VAR"
    echo "k(rounds := rounds); check := k.check; END_PROGRAM"
  done
  echo "CONFIGURATION Bench RESOURCE Host ON PLC"
  for name in "${names[@]}"; do echo "TASK T_$name(INTERVAL := T#10ms, PRIORITY := 1);"; done
  for name in "${names[@]}"; do echo "PROGRAM P_$name WITH T_$name : W_$name;"; done
  echo "END_RESOURCE END_CONFIGURATION"
}

# What is measured is what ships: the shared library of `rung build`, in CPU time, in turn with the code by hand.
measure_kernels() {  # kernels.st hand.cpp [OPTION]
  local modules= checks rounds
  for checks in none default; do
    "$rung" build "$1" --shared ${3:-} --checks=$checks -o "$work/$checks.so" || { echo "failed with exit code $?"; return; }
    modules=$modules${modules:+:}$checks=$work/$checks.so
  done
  if grep -q measure_hand.h "$2"; then
    compile_measure "$2"
    RUNG_BENCH_MODULES=$modules "$work/measure" >"$work/rows" || { echo "failed with exit code $?"; return; }
  else  # with a main of its own: alternating processes
    $cxx -std=c++17 -O2 "$2" -o "$work/hand"
    compile_measure tests/bench/modules_only.cpp
    rounds=$("$work/hand" | awk -F'\t' '{ printf "%s=%s ", $2, $3 }')
    rm -f "$work/rows"
    for _ in 1 2 3; do
      "$work/hand" >>"$work/rows"
      # shellcheck disable=SC2086
      RUNG_BENCH_MODULES=$modules "$work/measure" $rounds >>"$work/rows" || { echo "failed with exit code $?"; return; }
    done
  fi
  awk -F'\t' '
    !($2 in known) { known[$2] = 1; order[++n] = $2 }
    !(($1, $2) in time) || $4 < time[$1, $2] { time[$1, $2] = $4 }
    { sum[$1, $2] = $5 }
    function median(who,   i, k, v, t) {
      for (i = 1; i <= n; i++) v[i] = time[who, order[i]] / time["hand", order[i]]
      for (i = 2; i <= n; i++) for (k = i; k > 1 && v[k - 1] > v[k]; k--) { t = v[k]; v[k] = v[k - 1]; v[k - 1] = t }
      return n % 2 ? v[(n + 1) / 2] : (v[n / 2] + v[n / 2 + 1]) / 2
    }
    END {
      printf "%-10s %8s %12s %15s\n", "kernel", "hand s", "checks=none", "checks=default"
      for (i = 1; i <= n; i++) {
        k = order[i]; hand = time["hand", k]
        printf "%-10s %8.4f %11.2fx %14.2fx\n", k, hand, time["none", k] / hand, time["default", k] / hand
        if (sum["none", k] != sum["hand", k]) wrong = wrong " " k "(" sum["none", k] " for " sum["hand", k] ")"
        if (sum["default", k] != sum["hand", k]) wrong = wrong " " k "(" sum["default", k] " for " sum["hand", k] ")"
      }
      printf "%-10s %8s %11.2fx %14.2fx\n", "median", "", median("none"), median("default")
      if (wrong != "") print "check sums differ:" wrong
    }' "$work/rows"
}

compile_measure() {  # the file with main()
  $cxx -std=c++17 -O2 -I "$include" -I tests/bench "$1" tests/bench/measure.cpp "$runtime" -ldl -o "$work/measure"
}

# The code by hand alone: name and rounds of each kernel.
rounds_of() {  # hand.cpp
  if grep -q measure_hand.h "$1"; then
    compile_measure "$1"
    "$work/measure"
  else
    $cxx -std=c++17 -O2 "$1" -o "$work/hand"
    "$work/hand"
  fi
}

measure_interp() {  # kernels.st hand.cpp
  rounds_of "$2" >"$work/hand.tsv"
  local name rounds engine
  # A twentieth of the rounds is enough for the interpreter; the start is not counted.
  awk -F'\t' '{ print $2, int($3 / 20) + 1 }' "$work/hand.tsv" | while read -r name rounds; do
    for engine in native interp; do
      "$rung" run "$1" --engine=$engine -O2 --cycles 1 --set "P_$name.rounds=$rounds" --watch "P_$name.check" --trace - \
        --time-phases >"$work/$engine.csv" 2>"$work/$engine.times" || { echo "failed with exit code $?"; return; }
    done
    cmp -s "$work/native.csv" "$work/interp.csv" || echo "$name: results differ"
    echo "$name $(awk '$1 == "run" { print $2 }' "$work/native.times" "$work/interp.times" | tr '\n' ' ')"
  done | awk '
    NF == 3 { n++; r[n] = $2 > 0 ? $3 / $2 : 0; printf "%-10s %8.4f s %8.4f s %8.1fx\n", $1, $2, $3, r[n]; next }
    { print }
    END {
      for (i = 2; i <= n; i++) for (k = i; k > 1 && r[k - 1] > r[k]; k--) { t = r[k]; r[k] = r[k - 1]; r[k - 1] = t }
      printf "%-10s %30.1fx\n", "median", n % 2 ? r[(n + 1) / 2] : (r[n / 2] + r[n / 2 + 1]) / 2
    }'
}

interp() {
  echo "== interp: native code at -O2, the interpreter, and its multiple"
  measure_interp tests/bench/kernels/kernels.st tests/bench/kernels/hand.cpp
  if [ -n "$other_kernels" ]; then
    echo "-- $other_kernels"
    wrap "$other_kernels" >"$work/other.st"
    measure_interp "$work/other.st" "$other_kernels/hand.cpp"
  fi
}

kernels() {
  echo "== kernels: CPU time of what \`rung build --shared\` makes, as multiples of hand-written C++ at -O2"
  measure_kernels tests/bench/kernels/kernels.st tests/bench/kernels/hand.cpp
  echo "-- routines of plant programs"
  measure_kernels tests/bench/routines/kernels.st tests/bench/routines/hand.cpp
  echo "-- functions and blocks of libraries"
  measure_kernels tests/bench/functions/kernels.st tests/bench/functions/hand.cpp
  echo "-- routines of plant programs in a project whose code is in several files, -O2"
  { awk 'BEGIN { for (i = 100; i < 400; i++) print "FUNCTION Level" i " : DINT\nLevel" i " := " i ";\nEND_FUNCTION" }'
    cat tests/bench/routines/kernels.st; } >"$work/spread.st"
  measure_kernels "$work/spread.st" tests/bench/routines/hand.cpp -O2
  if [ -n "$other_kernels" ]; then
    echo "-- $other_kernels"
    wrap "$other_kernels" >"$work/other.st"
    measure_kernels "$work/other.st" "$other_kernels/hand.cpp"
  fi
}

for part in "${parts[@]}"; do "$part"; done
