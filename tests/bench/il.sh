#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The cost of Instruction List against the same ST: CPU time of both as compiled C++, and their ratio (wanted: 1).
# Usage: tests/bench/il.sh [RUNG]
rung=${1:-build/bin/rung}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

program() {  # BODY
  cat <<END
FUNCTION_BLOCK Filter
VAR_INPUT x : DINT; enable, hold : BOOL; END_VAR
VAR_OUTPUT y, count : DINT; high : BOOL; END_VAR
VAR last : DINT; END_VAR
$1
END_FUNCTION_BLOCK
PROGRAM Main
VAR f : Filter; i, s : DINT; END_VAR
FOR i := 1 TO 1000000 DO
  f(x := i MOD 1009, enable := i MOD 7 <> 0, hold := i MOD 11 = 0);
  s := s + f.y + f.count;
END_FOR
END_PROGRAM
END
}
program '
IF enable AND NOT hold THEN y := (3 * last + x + 2) / 4; END_IF
high := y > 500 OR (high AND y > 400);
IF high THEN count := count + 1; END_IF
last := MIN(MAX(y, 10), 900);' >"$folder/st.st"
program '
LD enable
ANDN hold
JMPCN kept
LD 3
MUL last
ADD x
ADD 2
DIV 4
ST y
kept:
LD y
GT 500
OR( high
AND( y
GT 400
)
)
ST high
JMPCN low
LD count
ADD 1
ST count
low:
LD y
MAX 10
MIN 900
ST last' >"$folder/il.st"

for language in st il; do
  for cycles in 1 101; do
    "$rung" run --engine=native -O2 --cycles=$cycles --watch=Main.s "$folder/$language.st" >"$folder/$language.out"
    best=
    for try in 1 2 3; do
      spent=$({ /usr/bin/time -f '%U' "$rung" run --engine=native -O2 --cycles=$cycles --watch=Main.s \
        "$folder/$language.st" >/dev/null; } 2>&1)
      best=$(echo "$best $spent" | awk 'NF == 1 || $2 < $1 { print $NF; next } { print $1 }')
    done
    [ $cycles = 1 ] && base=$best
  done
  eval "$language=$(echo "$best $base" | awk '{ print ($1 - $2) / 100 }')"
done
cmp -s "$folder/st.out" "$folder/il.out" || echo "the results differ"
echo "$st $il" | awk '{ printf "ST %.2f ns, IL %.2f ns a call: ratio %.2f\n", $1 * 1e3, $2 * 1e3, $2 / $1 }'
