#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The CPU time of `rung fmt` for 100 000 lines of ST that all change, and for the same lines once more, when none does
# (wanted: less than 0.5 s). The least of five runs each.
# Usage: tests/bench/fmt.sh [RUNG]
rung=$(realpath "${1:-build/bin/rung}")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1

# 1852 blocks of 54 lines.
awk 'BEGIN {
  for (block = 1; block <= 1852; ++block) {
    printf "function_block Valve%d\nvar_input\nopen,close:bool; // commands\nlevel:real:=%d.5; // m3\nend_var\n", block, block
    printf "var_output\nstate:int;\nend_var\nvar\ntimer:TON;\nlimits:array[1..4]of real:=[1.0,2.0,2(3.5)];\ni:int;\nend_var\n"
    for (part = 1; part <= 4; ++part) {
      printf "if open and not close then\nstate:=state+%d;\ntimer(IN:=level>%d.0,PT:=T#%dms);\n", part, part, part
      printf "elsif close or level<0.0 then (* empty *)\nfor i:=1 to 4 do\nlimits[i]:=limits[i]*2.0-level;\nend_for\nelse\nstate:=0;\nend_if\n"
    }
    print "end_function_block"
  }
}' >written.st

measure() {  # NAME, before each run: COMMAND
  least=
  for run in 1 2 3 4 5; do
    eval "$2"
    cpu=$( { /usr/bin/env time -f '%U %S' "$rung" fmt file.st; } 2>&1 | awk '{ print $1 + $2 }')
    least=$(printf '%s\n%s\n' "$cpu" "$least" | awk 'NF' | sort -n | head -1)
  done
  printf '%-12s %6d lines  %5.2f s\n' "$1" "$(wc -l <file.st)" "$least"
}
measure changed 'cp written.st file.st'
measure unchanged ':'
