#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Networks: their cost compared with the same logic in ST, and how fast a large project of them is read.
#   tests/bench/networks.sh [SEEDS] [MEGABYTES]
# code     CPU seconds of generated blocks in LD, FBD and CFC as multiples of their ST, native at -O2 (wanted: 1.05)
# import   seconds and memory of `rung check` for a PLCopen XML project (wanted for 50 MB: 3 s and 1 GiB, release build)
# RUNG names the tool (build/bin/rung); network_differential is beside it. Measure on a quiet machine.
set -eu
cd "$(dirname "$0")/../.."
rung=$(readlink -f "${RUNG:-build/bin/rung}")
generator=$(dirname "$rung")/network_differential
seeds=${1:-5} megabytes=${2:-50}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
forms=(st ld fbd cfc)

for seed in $(seq 1 "$seeds"); do
  "$generator" --print="$seed" | sed -n '/^==== blocks.st/,/^==== editor/p' | grep -v '^====' | sed '/^PROGRAM Main/,$d' >"$work/blocks"
  for form in "${forms[@]}"; do
    {
      cat "$work/blocks"
      echo "PROGRAM Main VAR b : B0_$form; s : UDINT := $seed; n : DINT; END_VAR FOR n := 1 TO 200000 DO"
      echo "s := s * 1664525 + 1013904223; b(a := s.31, b := s.30, c := s.29, d := s.28, i := UDINT_TO_DINT(s / 65536),"
      echo "j := UDINT_TO_DINT(s), k := UDINT_TO_INT(s / 8388608), which := UDINT_TO_INT(s / 65536 MOD 3), x := 1.5);"
      echo "END_FOR END_PROGRAM"
    } >"$work/$form.st"
    CXXFLAGS=-O2 "$rung" run --engine=native --cycles=1 "$work/$form.st" >/dev/null 2>&1  # compiles
  done
  for _ in 1 2 3; do
    for form in "${forms[@]}"; do
      TIMEFORMAT="$seed $form %U"
      { time CXXFLAGS=-O2 "$rung" run --engine=native --cycles=150 "$work/$form.st" >/dev/null 2>&1; } 2>>"$work/times"
    done
  done
done
# The best of each, interleaved: other load on the machine affects all alike.
[ ! -s "$work/times" ] || awk '!(($1, $2) in best) || $3 < best[$1, $2] { best[$1, $2] = $3; seeds[$1] }
  END { for (s in seeds) printf "code: seed %d: ST %.2f s, LD %.2fx, FBD %.2fx, CFC %.2fx\n", s, best[s, "st"],
        best[s, "ld"] / best[s, "st"], best[s, "fbd"] / best[s, "st"], best[s, "cfc"] / best[s, "st"] }' "$work/times"

# Repeats the same POUs, each time under other names.
"$generator" --print=1 >"$work/all"
sed -n '/^==== blocks.st/,/^==== editor/p' "$work/all" | grep -v '^====' | sed '/^FUNCTION_BLOCK B0_st/,$d' >"$work/types.st"
awk -v bytes=$((megabytes * 1000000)) '
  /^==== editor/ { on = 1; next } !on { next }
  /<pou name/ { in_pou = 1 }
  !in_pou { head = head $0 "\n" }
  in_pou { pous = pous $0 "\n" }
  END {
    sub(/<\/pous>.*/, "", head); end = pous; sub(/.*<\/pou>/, "", end); sub(/<\/pous>.*/, "", pous)
    printf "%s", head
    for (size = 0; size < bytes; size += length(pous)) { copy = pous; gsub(/B0_/, "B" ++n "_", copy); printf "%s", copy }
    print end
  }' "$work/all" >"$work/large.xml"
TIMEFORMAT='import: %U s CPU, %R s'
before=$(stat -c %s "$work/large.xml")
time "$rung" check --time-phases "$work/types.st" "$work/large.xml" 2>&1 | grep -E '^(phase|read|parse|check|total)|lines,|error' | head -20
echo "import: $before bytes"
