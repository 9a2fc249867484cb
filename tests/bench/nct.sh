#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# An NCT ladder of 10 000 rungs of the usual mix against the same logic in C++ over an array, and how fast it is read.
#   tests/bench/nct.sh [CYCLES]        default 20000
# cycle     CPU time of `rung build` code as a multiple of that of g++ -O2 (wanted: 1.2); both end with the same sum
# compile   CPU seconds of `rung emit`, all before g++ (wanted: 0.2)
# RUNG names the tool (build/bin/rung), CXX the compiler (g++).
set -eu
cd "$(dirname "$0")/../.."
rung=$(readlink -f "${RUNG:-build/bin/rung}")
[ -x "$rung" ] || { echo "$rung not found; build first (cmake --preset release && cmake --build build)" >&2; exit 2; }
cycles=${1:-20000}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# As in a machine, most bits stay as they are from cycle to cycle: fifty words in a thousand count.
# Bits are in words 5100 to 7099, registers from 7200, timers from 8300, counters from 8900. Each rung in both languages.
awk -v ladder="$work/mill.nct" -v code="$work/mill.cpp" '
  function random(n) { seed = (seed * 1103515245 + 12345) % 2147483648; return int(seed / 65536) % n }
  function bit() { word = 5100 + random(1000); place = random(32) }
  function l(text) { print text > ladder }
  function c(text) { print text > code }
  function contact(   kind) {
    bit(); kind = random(4)
    l(sprintf("  %s %04d.%02d", kind == 0 ? "INN" : "IN", word, place))
    return sprintf("%sget(%d, %d)", kind == 0 ? "!" : "", word, place)
  }
  function coil(power, name) { l(sprintf("  %s %04d.%02d", name, 6100 + int(out / 32), out % 32)); word = 6100 + int(out / 32); place = out++ % 32 }
  function register() { return 7200 + random(500) }
  BEGIN {
    seed = 4711
    l("PROGRAM mill"); l("MODULE MAIN")
    c("#include <cstdint>\n#include <cstdio>\n#include <cstdlib>")
    c("uint32_t mem[10000]; bool was[10000]; long stamp[10000], now;")
    c("static inline bool get(int w, int b) { return mem[w] >> b & 1; }")
    c("static inline void put(int w, int b, bool v) { mem[w] = (mem[w] & ~(1u << b)) | (uint32_t(v) << b); }")
    c("static inline bool rises(int k, bool v) { bool r = v && !was[k]; was[k] = v; return r; }")
    c("static inline bool tond(int k, int w, bool in, uint32_t preset) {\n  if (rises(k, in) || !in) { mem[w] = preset; stamp[k] = now; }\n" \
      "  else { long d = now - stamp[k]; stamp[k] = now; mem[w] = long(mem[w]) > d ? mem[w] - d : 0; }\n  return in && mem[w] == 0; }")
    c("static inline bool cntr(int k, int w, bool ck, uint32_t first, uint32_t last, uint32_t compare) {\n" \
      "  if (rises(k, ck)) mem[w] = mem[w] >= last ? first : mem[w] + 1;\n  return mem[w] == compare; }")
    c("void cycle() {")
    for (i = 0; i < 50; ++i) {  # what changes from cycle to cycle
      w = 5100 + i * 20
      l("RUNG\n  IN N_ON"); l(sprintf("  ADD %04d %04d #%d", w, w, 1013904223 * i % 65536))
      c(sprintf("  mem[%d] += %du;", w, 1013904223 * i % 65536))
    }
    for (n = 0; n < 9900; ++n) {
      l("RUNG"); kind = random(100)
      if (kind < 60) {
        p = contact() " && " contact()
        if (kind < 30) { l("  ("); p = p " && (" contact(); l("  |"); p = p " || " contact() ")"; l("  )") }
        coil(p, kind % 8 == 0 ? "OUTN" : "OUT"); c(sprintf("  put(%d, %d, %s(%s));", word, place, kind % 8 == 0 ? "!" : "", p))
      } else if (kind < 70) {
        p = contact(); coil(p, kind < 65 ? "SET" : "RST")
        c(sprintf("  if (%s) put(%d, %d, %s);", p, word, place, kind < 65 ? "true" : "false"))
      } else if (kind < 75) {
        bit(); r = register()
        l(sprintf("  IN @%04d.%02d\n  ADD %04d %04d #1", word, place, r, r))
        c(sprintf("  if (rises(%d, get(%d, %d))) ++mem[%d];", n, word, place, r))
      } else if (kind < 85) {
        p = contact(); a = register(); b = register(); r = register(); name = substr("ADDSUBANDXORMOV", 1 + 3 * random(5), 3)
        sign = name == "ADD" ? "+" : name == "SUB" ? "-" : name == "AND" ? "&" : "^"
        l(name == "MOV" ? sprintf("  MOV %04d %04d", r, a) : sprintf("  %s %04d %04d %04d", name, r, a, b))
        c(sprintf("  if (%s) mem[%d] = mem[%d]%s;", p, r, a, name == "MOV" ? "" : sprintf(" %s mem[%d]", sign, b)))
      } else if (kind < 93) {
        p = contact(); a = register(); name = random(2) ? "CGT" : "CEQ"; b = random(100)
        l(sprintf("  %s %04d #%d", name, a, b)); coil(p, "OUT")
        c(sprintf("  put(%d, %d, %s && int32_t(mem[%d]) %s %d);", word, place, p, a, name == "CGT" ? ">" : "==", b))
      } else if (kind < 98) {
        p = contact(); t = 8300 + timers++; preset = 20 + random(200)
        l(sprintf("  TOND %04d #%d #0", t, preset)); coil(p, "OUT")
        c(sprintf("  put(%d, %d, tond(%d, %d, %s, %d));", word, place, n, t, p, preset))
      } else {
        l("  [ CK"); p = contact(); l("  | U/D\n    IN N_OFF\n  | R\n    IN N_OFF\n  ]")
        t = 8900 + counters++; l(sprintf("  CNTR %04d #1 #12 #7", t)); coil(p, "OUT")
        c(sprintf("  put(%d, %d, cntr(%d, %d, %s, 1, 12, 7));", word, place, n, t, p))
      }
    }
    for (i = 0; i < 50; ++i) {
      w = i % 2 ? 6100 + i * 5 : 7200 + i * 7
      l("RUNG\n  IN N_ON"); l(sprintf("  MUL 9900 9900 #31")); l(sprintf("  XOR 9900 9900 %04d", w))
      c(sprintf("  mem[9900] = mem[9900] * 31u ^ mem[%d];", w))
    }
    l("END_MODULE")
    c("}\nint main(int, char** v) {\n  const int n = atoi(v[1]);\n  for (int k = 0; k < n; ++k) { cycle(); now += 10; }")
    c("  printf(\"9900 = %u\\n\", mem[9900]);\n}")
  }'

TIMEFORMAT=%U
"$rung" emit "$work/mill.nct" -o "$work/code"
best=9
for _ in 1 2 3; do
  seconds=$({ time "$rung" emit "$work/mill.nct" -o "$work/code"; } 2>&1)
  best=$(awk -v a="$best" -v b="$seconds" 'BEGIN { print b < a ? b : a }')
done
echo "compile: $best s"
"$rung" build "$work/mill.nct" -o "$work/mill" >/dev/null
"${CXX:-g++}" -O2 -o "$work/hand" "$work/mill.cpp"
sum=$("$work/mill" --cycles "$cycles" --watch 9900 | head -1)
[ "$sum" = "$("$work/hand" "$cycles")" ] || { echo "different results: $sum, $("$work/hand" "$cycles")" >&2; exit 1; }
# A control that does nothing, as that of the C++.
cat > "$work/control.c" <<'END'
#include <stddef.h>
#include "rung/nc.h"
static void exchange(void* data, uint32_t* slice, uint32_t* nonvolatile, bool is_cycle, int64_t now_ns) {
  (void)data, (void)slice, (void)nonvolatile, (void)is_cycle, (void)now_ns;
}
const rung_nc* rung_numerical_control(const char* argument, void** data);
const rung_nc* rung_numerical_control(const char* argument, void** data) {
  static rung_nc control;
  control.exchange = exchange;
  *data = NULL;
  return argument == NULL ? NULL : &control;
}
END
gcc -O2 -shared -fPIC -I stdlib/runtime/include "$work/control.c" -o "$work/control.so"
for _ in 1 2 3 4 5; do  # interleaved: other load on the machine affects all alike
  { time "$work/mill" --driver "$work/control.so=none" --cycles "$cycles" --watch 9900 >/dev/null; } 2>>"$work/of_ladder"
  { time "$work/mill" --cycles "$cycles" --watch 9900 >/dev/null; } 2>>"$work/of_both"
  { time "$work/hand" "$cycles" >/dev/null; } 2>>"$work/of_hand"
done
paste <(sort -n "$work/of_ladder") <(sort -n "$work/of_both") <(sort -n "$work/of_hand") | awk -v cycles="$cycles" 'NR == 1 {
  printf "cycle: ladder %.1f us (with the simulated control %.1f us), C++ %.1f us, %.2f times\n",
    $1 / cycles * 1e6, $2 / cycles * 1e6, $3 / cycles * 1e6, $1 / $3 }'
