#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The build step, with Ninja and with make: a first build, nothing to do, a touched source, a changed body, a new file, a
# mistake. PREFIX is an installed Rung (cmake --install build --prefix PREFIX); paths with blanks are part of the test.
#   tests/programs/cmake_project/check.sh PREFIX
set -eu
prefix=$(readlink -f "$1")
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "$generator: $1"; tail -20 "$work/log"; exit 1; }
build() { cmake --build "$work/build dir" -v >"$work/log" 2>&1; }
compiles() { grep -c -- ' -c .*bundle' "$work/log" || true; }
emits() { grep -c 'rung"\{0,1\} emit' "$work/log" || true; }

for generator in Ninja "Unix Makefiles"; do
  rm -rf "$work"/*
  cp -r "$here" "$work/source dir"
  cmake -S "$work/source dir" -B "$work/build dir" -G "$generator" -DCMAKE_PREFIX_PATH="$prefix" >"$work/log" 2>&1 || fail "configure failed"
  build || fail "the first build failed"
  [ "$("$work/build dir/press")" = "strokes 50" ] || fail "the program prints something else"

  build || fail "a second build failed"
  [ "$(emits)" = 0 ] && [ "$(compiles)" = 0 ] || fail "there was nothing to do, but something ran"

  sleep 1.1
  touch "$work/source dir/plc/press.st"
  build || fail "the build after a touch failed"
  [ "$(emits)" = 1 ] && [ "$(compiles)" = 0 ] || fail "a touched source: rung ran $(emits) times, compilers $(compiles) times"
  build || fail "the build after that failed"
  [ "$(emits)" = 0 ] || fail "rung runs again at every build"

  sleep 1.1
  sed -i 's/counter.total \* 10/counter.total * 7/' "$work/source dir/plc/press.st"
  build || fail "the build after a change failed"
  [ "$("$work/build dir/press")" = "strokes 35" ] || fail "the change did not arrive in one build"

  sleep 1.1
  printf 'FUNCTION Unused : INT\nUnused := 1;\nEND_FUNCTION\n' >"$work/source dir/plc/unused.st"
  build || fail "the build with a new file failed"
  [ "$(emits)" = 1 ] || fail "a new file in the folder was not seen"

  sleep 1.1
  sed -i 's/counter.total/countre.total/' "$work/source dir/plc/press.st"
  build && fail "a mistake in the source was not reported"
  grep -q 'press.st:[0-9]*:[0-9]*: error\[E' "$work/log" || fail "no message names the mistake's place"
done
echo "cmake project: first build, nothing to do, touch, change, new file and mistake are right with Ninja and make"
