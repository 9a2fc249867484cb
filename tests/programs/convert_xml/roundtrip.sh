#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Writes each program as PLCopen XML, checks the file by the rules of the schema, and compares the IR of the program
# with that of the file: locations and the order of declarations may differ.
# --std=… is taken from a line `// args:` of a file. Tests become programs, because a product has no tests.
#   roundtrip.sh FILE|FOLDER...
here=$(dirname "$0")
out=$(mktemp -d)
ir() {
  rung emit --emit=ir "$@" 2>"$out/errors" | sed -E 's/"[^"]*":[0-9]+//g; s/Transition(_[0-9]+)?|sfc_condition_n?[0-9]+/Transition/g; s/^dispatch .*/\n&\n/' |
    awk 'BEGIN { RS = ""; ORS = "\n\n" } { gsub(/\n/, "\r"); print }' | sort | tr '\r' '\n' | sed '/^$/d; s/ *$//'
}
count=0
for program; do
  # A program that is wrong on purpose.
  if grep -qs '^// expect: .*: error\[' "$program"; then continue; fi
  args=$(sed -nE 's/^\/\/ args: //p' "$program" 2>/dev/null)
  rm -rf "$out/xml" "$out/p"
  cp -r "$program" "$out/p" 2>/dev/null
  if [ -f "$program" ]; then
    rm -f "$out/p" && mkdir "$out/p"
    sed "s/{test}//; s/{attribute 'test'}//" "$program" >"$out/p/$(basename "$program")"
  fi
  # shellcheck disable=SC2086
  if ! rung convert "$out/p" --to xml -o "$out/xml" $args >"$out/errors" 2>&1; then
    echo "$program: not written: $(grep -m1 'error' "$out/errors")"
    continue
  fi
  python3 "$here/tc6.py" "$out"/xml/*.xml
  ir "$out/p" $args >"$out/before"
  ir "$out/xml" $args >"$out/after"
  if cmp -s "$out/before" "$out/after"; then
    count=$((count + 1))
  else
    echo "$program: another IR"
    grep -m1 error "$out/errors"
    diff "$out/before" "$out/after" | head -${LINES_OF_DIFF:-6}
  fi
done
echo "$count the same"
rm -rf "$out"
