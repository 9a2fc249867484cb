#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# What takes long: hours of generated programs, mutants and checked builds. Each part is seeded and repeatable, ends with
# a line of its own figures, and fails with exit code 1 when it finds something.
#   tools/long.sh [PART...]      all parts without one
# differential  20 000 random programs in three dialects: interpreter and, of every tenth, g++ and clang++ (COUNT, FIRST)
# networks      2 000 random networks and charts and 2 000 blocks in IL, against what they must compute (COUNT, FIRST)
# mutants       40 000 corrupted programs, drawings and ladders: one error at the right place, and no crash (COUNT, FIRST)
# frames        what peers of Modbus and the freeport send: seeded frames, and libFuzzer (COUNT, FIRST, SECONDS_EACH; needs clang++)
# snapshots     10 000 random edits of a project of 100 000 lines, and 200 in each folder: snapshots equal a check, and what
#               they cost (COUNT, FIRST)
# rename        1 500 random renames in projects and files of all formats: equal C++ but for the name (COUNT, FIRST)
# debugger      steps of every kind, forward and back, through all conformance programs, 100 programs with peers and
#               files, and 60 sessions of requests in any order
# adapter       sessions with `rung dap` by the client that Microsoft tests adapters with (needs npm)
# typing        20 files of each folder of samples and vendors' projects typed from the first character to the last in the
#               language server, and random edits: it says what a cold check says (COUNT, FIRST)
# editor_fuzz   40 000 messages of a stranger to the language server: one answer to each request, and no end (COUNT, FIRST)
# editor        10 000 edits of a project of 100 000 lines with requests in between: CPU time of each, and memory (COUNT)
# changes       1 000 random edits of running programs: what keeps its value, and how the program goes on (COUNT, FIRST)
# forces        10 000 random sequences of force, unforce, write, stop and cycles against a model (COUNT, FIRST)
# monitor       20 000 random and damaged requests to the monitor of a program that runs (COUNT, FIRST)
# modifiers     each modifier left out of the programs of its row: some test notices
# bodies        each body of the libraries left out: some test notices
# mutation      300 mistakes in the compiler and the runtime, drawn at random: 95 % of them are noticed (COUNT, SEED)
# profiles      five million motion profiles: limits, continuity, arrival, and no rival faster (COUNT, FIRST)
# cams          200 random cams, 100 s of four slaves each: no set position further than 1e-9 of the stroke from the exact curve (COUNT, FIRST)
# kills         10 000 programs killed while they write retained data (COUNT, FIRST)
# tsan          the bundled host with tasks as threads under ThreadSanitizer
# service       the systemd unit of samples/service under systemd in a namespace (root; needs the package systemd)
# page          1 000 values at 10 updates a second in headless Chromium for a minute: under 20 % of a core (SECONDS_EACH)
# vscode        the extension for Visual Studio Code: its grammars, and used with keys in a real editor (needs npm, chromium, libkrb5-dev)
# kate          Kate with the settings of its page, used with keys (needs kate, xvfb, xdotool, openbox)
# lateness      starts of a task of 1 ms beside a bare loop, five minutes of each (SECONDS_EACH)
# asan          the whole suite with ASan and UBSan (needs clang++, which builds it in a third of the time)
# debug         the whole suite without optimization, with the invariants of the compiler checked
# tidy          clang-tidy over every file
# conversions   every conformance program converted to ST and to PLCopen XML: its tests pass as before; every keyword and
#               library word as a name
# conformance   the conformance suite exported, every row of edition 3 or its reason, and run with Rung, interpreted and compiled
# packages      the packages in a bare Debian 12 and a bare Debian 11 (root; needs debootstrap and lintian)
# compilers     every conformance program's C++ compiled by clang++ too (needs clang++)
set -eu
cd "$(dirname "$0")/.."
bin=$PWD/build/bin
first=${FIRST:-1}
failed=()

needs() { [ -x "$bin/$1" ] || { tools/install-packages.sh --tests; cmake --preset release; cmake --build build; }; }

differential() {
  needs differential
  local count=${COUNT:-20000}
  "$bin/differential" --ways=interp --first="$first" --count="$count" -j 2
  "$bin/differential" --ways=turns --first="$first" --count=$((count / 10)) -j 2
}

networks() {
  needs network_differential
  local count=${COUNT:-2000}
  "$bin/network_differential" --first="$first" --count="$count" -j 2
  "$bin/sfc_differential" --first="$first" --count="$count"
  "$bin/il_differential" --first="$first" --count="$count" -j 2
}

mutants() {
  needs mutation_test
  local test
  for test in mutation_test drawing_mutation_test network_mutation_test ladder_mutation_test; do
    RUNG_MUTATION_SEED=$first RUNG_MUTATION_COUNT=${COUNT:-10000} "$bin/$test"
  done
}

frames() {
  needs runtime_test
  RUNG_MUTATION_SEED=$first RUNG_MUTATION_COUNT=${COUNT:-1000000} "$bin/runtime_test" --gtest_filter='Modbus.*' --gtest_brief=1
  tests/fuzz/frames/frames.sh "${SECONDS_EACH:-300}" "$first"
}

snapshots() {
  needs snapshot_edits
  local folder
  folder=$(mktemp -d)
  tests/bench/project.py "$folder"
  "$bin/snapshot_edits" "$folder" "${COUNT:-10000}" "$first" 100
  local sources
  for sources in samples/*/ tests/conformance/*/*/; do
    ls "$sources"*.st >/dev/null 2>&1 || continue
    "$bin/snapshot_edits" "$sources" 200 "$first" 1 >"$folder/log" || { cat "$folder/log"; exit 1; }
  done
  rm -r "$folder"
}

rename() {
  needs rung
  local files
  mapfile -t files < <(find tests/conformance/language tests/conformance/standard -name '*.st' -o -name '*.xml' | sort)
  PATH=$bin:$PATH tests/lsp/rename.py --seed "$first" --count "$((${COUNT:-1500} / 500))" --verbose "${files[@]}"
  PATH=$bin:$PATH tests/lsp/rename.py --seed "$first" --count 20 --verbose samples/*/ tests/programs/vendor/*/
}

adapter() {
  needs rung
  local folder
  folder=$(mktemp -d)
  sed -n '/^```st filler.st/,/^```$/p' docs/debugging.md | sed '1d;$d' >"$folder/filler.st"
  (cd "$folder" && npm init -y >npm.log && npm install @vscode/debugadapter-testsupport@1.68.0 >>npm.log &&
   PATH=$bin:$PATH node "$OLDPWD/tests/dap/testsupport.js" filler.st)
  rm -r "$folder"
}

debugger() {
  needs rung
  local programs
  mapfile -t programs < <(find tests/conformance -name '*.st' | sort)
  PATH=$bin:$PATH tests/dap/steps.py --tests --stops 400 "${programs[@]}"
  PATH=$bin:$PATH tests/dap/services.py --programs 100 --seed 7
  PATH=$bin:$PATH tests/dap/fuzz.py --seed 1 --seeds 60 samples/tank
}

typing() {
  needs rung
  local folder
  for folder in samples/*/ tests/programs/vendor/*/; do
    case $folder in samples/embedding/ | samples/library/ | samples/rtos/ | samples/service/) continue ;; esac
    echo "$folder"
    PATH=$bin:$PATH tests/lsp/edits.py "$folder" --seed "$first" --type "${COUNT:-20}"
    PATH=$bin:$PATH tests/lsp/edits.py "$folder" --seed "$first" --pauses "${COUNT:-20}"
  done
}

editor_fuzz() {
  needs rung
  PATH=$bin:$PATH tests/lsp/fuzz.py "$first" "${COUNT:-40000}"
}

editor() {
  needs rung
  PATH=$bin:$PATH RUNG_CLIENT_SECONDS=7200 tests/bench/editor.py "${COUNT:-10000}"
}

changes() {
  needs rung
  PATH=$bin:$PATH tests/online_change/edits.py "${COUNT:-1000}" "$first"
}

forces() {
  needs session_test
  RUNG_FORCES_SEED=$first RUNG_FORCES_COUNT=${COUNT:-10000} "$bin/session_test" --gtest_filter='Forces.*' --gtest_brief=1
}

monitor() {
  needs rung
  local folder way
  folder=$(mktemp -d)
  cp tests/monitor/fuzzed.st "$folder"
  for way in "" --realtime; do
    # shellcheck disable=SC2086
    PATH=$bin:$PATH tests/monitor/fuzz.py "$first" "${COUNT:-20000}" rung run "$folder/fuzzed.st" -Wno-all $way
  done
  rm -r "$folder"
}

modifiers() {
  needs rung_test_runner
  tests/modifiers/modifiers.py
}

bodies() {
  needs rung_test_runner
  tests/bodies/bodies.py
}

mutation() { tests/mutation/mutation.py; }

profiles() {
  needs motion_profile_test
  RUNG_PROFILE_SEED=$first RUNG_PROFILE_COUNT=${COUNT:-1000000} "$bin/motion_profile_test"
}

cams() {
  needs rung
  local folder seed
  folder=$(mktemp -d)
  for ((seed = first; seed < first + ${COUNT:-200}; ++seed)); do
    sed "s/SEED : ULINT := 42/SEED : ULINT := $seed/; s/CYCLES : DINT := 20000/CYCLES : DINT := 100000/" tests/conformance/machines/motion/cam_judge.st >"$folder/$seed.st"
    "$bin/rung" test "$folder/$seed.st" --engine=native --timeout T#5m >"$folder/log" 2>&1 || { grep -v warning "$folder/log" | tail -5; echo "seed $seed"; exit 1; }
  done
  echo "$((seed - first)) seeds, 100000 cycles of four slaves each: within 1e-9 of the stroke"
  rm -r "$folder"
}

kills() {
  needs rung
  tools/house/kill_retain.sh "${COUNT:-10000}" "$first"
}

tsan() {
  needs rung
  tools/house/tsan.sh
}

service() {
  needs rung
  tools/house/service.sh
}

page() {
  needs rung
  PATH=$bin:$PATH PYTHONDONTWRITEBYTECODE=1 python3 tests/programs/page/load.py "${SECONDS_EACH:-60}" | tee /dev/stderr | grep -q '^within'
}

vscode() {
  needs rung
  tools/vscode/test/grammar.sh
  tools/vscode/test/editor/editor.sh
}

kate() {
  needs rung
  local folder
  folder=$(mktemp -d)
  tests/lsp/kate.py "$folder" "$bin/rung" || { echo "see $folder"; return 1; }
  rm -r "$folder"
}

lateness() {
  needs rung
  tests/bench/lateness.sh "${SECONDS_EACH:-60}"
}

suite() {  # preset
  tools/install-packages.sh --tests
  cmake --preset "$1"
  cmake --build "build/$1"
  "build/$1/bin/rung_test_runner"
}
asan() { CXX=clang++ suite asan; }
debug() { suite debug; }

tidy() { tools/clang_tidy.sh; }

# Not the programs that show their own line numbers.
conversions() {
  needs rung
  local files
  files=$(ls tests/conformance/*/*/*.st tests/conformance/language/plcopen/*.xml | grep -v 'pointers/what_is_known\|/nct')
  # shellcheck disable=SC2086
  PATH=$bin:$PATH python3 tests/programs/convert_st/tests_pass.py $files
  PATH=$bin:$PATH python3 tests/programs/convert_st/names.py
}

packages() { tools/package/try.sh; }

conformance() {
  needs rung_conformance
  local folder engine
  folder=$(mktemp -d)
  "$bin/rung_conformance" export "$folder"
  for engine in interp native; do
    "$folder/conformance.py" run --adapter "$folder/adapters/rung.py --rung $bin/rung --engine $engine" -q -v --timeout 120
  done
  rm -r "$folder"
}

compilers() {
  needs rung_test_runner
  local sample folder
  folder=$(mktemp -d)
  for sample in samples/*/; do  # without warnings
    case $sample in samples/embedding/ | samples/library/ | samples/service/) continue ;; esac
    "$bin/rung" emit "$sample" -Wno-all -o "$folder/$sample" >/dev/null
    ls "$folder/$sample"/*.cpp | xargs -P 2 -I{} clang++ -std=c++17 -Wall -Wextra -Werror -fsyntax-only -I stdlib/runtime/include -I "$folder/$sample" {}
  done
  rm -r "$folder"
  CXX=clang++ "$bin/rung_test_runner" tests/conformance
}

all=(differential networks mutants frames snapshots rename typing editor_fuzz editor debugger adapter changes forces monitor page modifiers bodies mutation profiles cams kills tsan
     service vscode kate lateness asan debug tidy conversions conformance packages compilers)
parts=("$@")
[ ${#parts[@]} -gt 0 ] || parts=("${all[@]}")
for part in "${parts[@]}"; do
  [[ " ${all[*]} " == *" $part "* ]] || { sed -n '3,/^set -eu/s/^# \{0,1\}//p' "$0" >&2; exit 2; }
done
for part in "${parts[@]}"; do
  echo "== $part"
  begin=$SECONDS
  set +e
  (set -e; "$part")
  status=$?
  set -e
  [ $status -eq 0 ] || failed+=("$part")
  echo "== $part: $((SECONDS - begin)) s"
done
[ ${#failed[@]} -eq 0 ] || { echo "failed: ${failed[*]}"; exit 1; }
