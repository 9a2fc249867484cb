#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# No accepted program fails in g++ or clang++: keywords of C and C++, words of POSIX, common macros and names of
# generated code as variables, fields, enumeration items, functions, blocks, types, programs, tasks and pins. Words that
# `rung check` rejects as keywords of IEC 61131-3 are left out.
#   tests/programs/identifiers/check.sh RUNG [COMPILER ...]
set -eu
rung=$(readlink -f "$1")
shift
[ $# -gt 0 ] || set -- g++ clang++
words=$(dirname "$(readlink -f "$0")")/words.txt
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

# Leaves out the words that the language rejects: its keywords, `_` at an end or twice in codesys warnings.
accepted=""
for word in $(cat "$words"); do
  printf 'PROGRAM Tester\nVAR %s : INT; END_VAR\n%s := %s + 1;\nEND_PROGRAM\n' "$word" "$word" "$word" >word.st
  printf 'FUNCTION_BLOCK %s\nEND_FUNCTION_BLOCK\n' "$word" >block.st  # CHAR can be a variable of codesys, not a type
  "$rung" check block.st 2>&1 | grep -q 'E0214\|E0215' && continue
  if "$rung" check word.st >word.log 2>&1; then accepted="$accepted $word"; elif ! grep -q 'E0215\|E0217\|E01' word.log; then cat word.log; exit 1; fi
done
# Two names of IEC 61131-3 are different only when they differ in more than case.
accepted=$(for word in $accepted; do echo "$word"; done | sort -fu)

each() { for word in $accepted; do echo "${1//@/$word}"; done; }
mkdir variables pins fields items functions blocks types programs lists
{ echo "PROGRAM Tester"; echo "VAR"; each "  @ : INT;"; echo "END_VAR"; each "@ := @ + 1;"; echo "END_PROGRAM"; } >variables/main.st
{ echo "FUNCTION F_ : INT"; echo "VAR_INPUT"; each "  @ : INT := 1;"; echo "END_VAR"; each "F_ := F_ + @;"; echo "END_FUNCTION"
  echo "FUNCTION G_ : INT"; echo "VAR_IN_OUT"; each "  @ : STRING;"; echo "END_VAR"; each "@ := CONCAT(@, 'a');"; echo "END_FUNCTION"
  echo "FUNCTION_BLOCK B_"; echo "VAR_INPUT"; each "  @ : BOOL;"; echo "END_VAR"; echo "VAR_OUTPUT n_n : INT; END_VAR"; each "IF @ THEN n_n := n_n + 1; END_IF"; echo "END_FUNCTION_BLOCK"
  echo "PROGRAM Tester"; echo "VAR instance_ : B_; n_n : INT; END_VAR"; echo "n_n := F_();"; each "instance_(@ := TRUE);"; echo "END_PROGRAM"; } >pins/main.st
{ echo "TYPE Record_ : STRUCT"; each "  @ : INT := 1;"; echo "END_STRUCT END_TYPE"; echo "PROGRAM Tester"; echo "VAR r_r : Record_; END_VAR"; each "r_r.@ := r_r.@ + 1;"; echo "END_PROGRAM"; } >fields/main.st
{ echo "TYPE Items_ : ("; each "  @," | sed '$s/,$//'; echo "); END_TYPE"; echo "PROGRAM Tester"; echo "VAR e_e : Items_; n_n : INT; END_VAR"; each "IF e_e = Items_#@ THEN n_n := n_n + 1; END_IF"; echo "END_PROGRAM"; } >items/main.st
{ each "FUNCTION @ : INT VAR_INPUT x_x : INT; END_VAR @ := x_x + 1; END_FUNCTION"; echo "PROGRAM Tester"; echo "VAR n_n : INT; END_VAR"; each "n_n := @(n_n);"; echo "END_PROGRAM"; } >functions/main.st
{ each "FUNCTION_BLOCK @ VAR n_n : INT := 1; END_VAR n_n := n_n + 1; END_FUNCTION_BLOCK"; echo "PROGRAM Tester"; echo "VAR"; each "  v_@ : @;"; echo "END_VAR"; each "v_@();"; echo "END_PROGRAM"; } >blocks/main.st
{ echo "TYPE"; each "  @ : STRUCT n_n : INT := 1; s_s : STRING; END_STRUCT"; echo "END_TYPE"; echo "PROGRAM Tester"; echo "VAR"; each "  v_@ : @;"; echo "END_VAR"; each "v_@.n_n := 2;"; echo "END_PROGRAM"; } >types/main.st
{ each "PROGRAM @ VAR n_n : INT := 1; END_VAR n_n := n_n + 1; END_PROGRAM"; } >programs/main.st
{ echo "VAR_GLOBAL"; each "  @ : INT := 1;"; echo "END_VAR"; echo "PROGRAM Tester"; each "@ := @ + 1;"; echo "END_PROGRAM"
  echo "CONFIGURATION class_ VAR_GLOBAL g_g : INT; END_VAR RESOURCE namespace_ ON PLC"; each "TASK t_@(INTERVAL := T#10ms);" | awk 'NR % 90 == 0 { print "END_RESOURCE RESOURCE r_" NR " ON PLC" } { print } /^TASK t_class\(/ { print "PROGRAM int_ WITH t_class : Tester;" }'  # a resource has at most 100
  echo "END_RESOURCE END_CONFIGURATION"; } >lists/main.st

for project in *; do
  [ -d "$project" ] || continue
  for compiler in "$@"; do
    for level in -O0 -O1; do
      if ! CXX=$compiler "$rung" run "$project" $level --cycles 2 >log 2>&1; then
        echo "identifiers as $project ($compiler, $level):"
        grep -v warning log | grep error | head -20
        exit 1
      fi
    done
  done
done
echo "identifiers: $(echo "$accepted" | wc -w) words in nine places, with $*"
