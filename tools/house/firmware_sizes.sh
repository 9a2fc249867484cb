#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The table of code and data sizes in docs/embedding.md: each sample compiled for a Cortex-M4 at -Os and linked with what
# it uses of the runtime. Needs arm-none-eabi-g++ and its C library; RUNG names the tool (build/bin/rung).
#   tools/house/firmware_sizes.sh            prints the table
#   tools/house/firmware_sizes.sh --update   writes it into docs/embedding.md
#   tools/house/firmware_sizes.sh --check    prints the rows that differ by more than a fifth; exit code 1 if there are any
set -eu
cd "$(dirname "$0")/../.."
rung=$(readlink -f "${RUNG:-build/bin/rung}")
page=docs/embedding.md
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
flags=(-std=c++17 -Os -mcpu=cortex-m4 -mthumb -ffunction-sections -fdata-sections -fno-exceptions -fno-rtti -ffp-contract=off
       -I stdlib/runtime/include)

compile() {  # object, source, options
  arm-none-eabi-g++ "${flags[@]}" "${@:3}" -c "$2" -o "$1"
}

# What ld keeps of the objects when only `root` is asked for: bytes of code, and of constants.
linked_sizes() {  # root, objects
  arm-none-eabi-ld -r --gc-sections --gc-keep-exported -u "$1" "${@:2}" -o "$work/linked.o" 2>/dev/null ||
    arm-none-eabi-ld -r --gc-sections -u "$1" "${@:2}" -o "$work/linked.o"
  arm-none-eabi-objdump -h "$work/linked.o" | awk '
    function number(hex,   i, n) { for (i = 1; i <= length(hex); i++) n = n * 16 + index("0123456789abcdef", substr(hex, i, 1)) - 1; return n }
    $2 ~ /^\.text/ { code += number($3) }
    $2 ~ /^\.(rodata|data)/ { constants += number($3) }
    END { print code + 0, constants + 0 }'
}

native_blocks=$(dirname "$(dirname "$rung")")/tools/native_table/include
for source in stdlib/runtime/src/*.cpp stdlib/*/native/*.cpp stdlib/*/*/native/*.cpp stdlib/motion/profile/*.cpp; do
  [ -f "$source" ] || continue
  compile "$work/$(echo "$source" | tr / _).o" "$source" -I "$native_blocks"
done
arm-none-eabi-ar rc "$work/runtime.a" "$work"/*.o
rm "$work"/*.o

table() {
  echo '| sample | code | tables | runtime | RAM |'
  echo '|---|---|---|---|---|'
  local sample name code tables all_code all_tables ram
  for sample in boiler cascade conveyor embedding/plant.st filling_station motor_starter pid_loop tank traffic_light; do
    name=${sample%/*}
    rm -rf "$work/gen" "$work"/*.o
    "$rung" emit "samples/$sample" --target-pointer=4 --name "$name" -o "$work/gen" 2>/dev/null
    for source in "$work"/gen/*.cpp; do compile "$work/$(basename "$source").o" "$source"; done
    read -r code tables <<<"$(linked_sizes "${name}_module" "$work"/*.cpp.o)"
    read -r all_code all_tables <<<"$(linked_sizes "${name}_module" "$work"/*.cpp.o "$work/runtime.a")"
    # Blocks and areas are what the host has to provide.
    ram=$(awk -F'"size": ' '/^"(symbols|types)"/ { exit } NF > 1 { sum += $2 + 0 } END { print sum }' "$work/gen/symbols.json")
    echo "| $name | $code | $tables | $((all_code + all_tables - code - tables)) | $ram |"
  done
}

table >"$work/table"
case ${1-} in
  '') cat "$work/table" ;;
  --update)
    awk -v file="$work/table" '
      /^\| sample \|/ { while ((getline line <file) > 0) print line; skip = 1; next }
      skip && /^\|/ { next }
      { skip = 0; print }' "$page" >"$work/page"
    cp "$work/page" "$page" ;;
  --check)
    awk -F'|' '
      !/^\| [a-z_]+ +\|/ || /^\| sample/ { next }
      NR == FNR { for (i = 3; i <= 6; i++) is[$2, i] = $i + 0; next }
      ($2, 3) in is {
        seen++
        for (i = 3; i <= 6; i++) {
          difference = $i - is[$2, i]
          if (difference < 0) difference = -difference
          if (difference > is[$2, i] / 5 + 16) { print "docs/embedding.md has" $0; print "it is " is[$2, 3], is[$2, 4], is[$2, 5], is[$2, 6] "; run tools/house/firmware_sizes.sh --update"; bad = 1; break }
        }
      }
      END { if (seen == 0) { print "docs/embedding.md has no table"; bad = 1 } exit bad }' "$work/table" "$page" ;;
  *) sed -n '2,6s/^# \{0,1\}//p' "$0" >&2; exit 2 ;;
esac
