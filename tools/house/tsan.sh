#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The bundled host under ThreadSanitizer: compiles it with -fsanitize=thread and runs the programs with several tasks in
# tools/house/tsan in real time, with tasks that take turns and, where permitted, with SCHED_FIFO. The code of the
# programs is not instrumented: plain globals are shared without order by design (docs/language.md). A version with the
# same text takes over twice while they run. Called by tools/long.sh.
#   tools/house/tsan.sh [NAME]      only tsan/NAME
set -eu
here=$(cd "$(dirname "$0")/../.." && pwd)
rung=${RUNG:-$here/build/bin/rung}
lib=$(dirname "$rung")/../lib
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
runtime=$here/stdlib/runtime
mkdir "$folder/host"
flags="-std=c++17 -O1 -g -fsanitize=thread -I $runtime/include -I $runtime -I $runtime/host -I $here/stdlib/nct -I $here -I $lib/../stdlib/runtime/embedded"
ls "$runtime"/src/*.cpp "$runtime"/host/*.cpp "$runtime"/host/modules/*.cpp "$here"/stdlib/nct/control/*.cpp "$lib"/../stdlib/runtime/embedded/*.cpp | xargs -P "$(nproc)" -I{} sh -c \
  'g++ '"$flags"' -c {} -o '"$folder"'/host/$(basename $(dirname {}))_$(basename {} .cpp).o'
gcc -std=c99 -shared -fPIC -I "$runtime/include" "$here/tests/programs/tasks/log_driver.c" -o "$folder/log.so"
cat > "$folder/main.cpp" <<'END'
#include "rung/host.h"
extern "C" const rung_module* plant_module(void);
int main(int argc, char** argv) { return rung::host::applicationMain(*plant_module(), argc, argv); }
END
failed=0
for program in "$here"/tools/house/tsan/${1:-*}.st "$here"/tools/house/tsan/${1:-*}.nct; do
  [ -e "$program" ] || continue
  name=$(basename "$program")
  name=${name%.*}
  driver="--driver log.so=log"
  [ -e "$here/tools/house/tsan/$name.st" ] || driver=""  # a ladder has no %I and %Q
  commands=$here/tools/house/tsan/commands.txt
  if [ -n "$driver" ]; then
    sort -s -n -k 1,1 "$commands" "$here/tools/house/tsan/values.txt" > "$folder/commands.txt"
    commands=$folder/commands.txt
  fi
  options=$(sed -n 's,^// options: ,,p' "$program")
  "$rung" emit "$program" --name plant --online-change -Wno-all -o "$folder/$name" > /dev/null
  "$rung" build "$program" --name plant --online-change --shared -Wno-all -o "$folder/next.so" > /dev/null
  ls "$folder/$name"/*.cpp | xargs -P "$(nproc)" -I{} g++ -std=c++17 -O1 -I "$runtime/include" -I "$folder/$name" -c {} -o {}.o
  g++ $flags "$folder/main.cpp" "$folder/$name"/*.o "$folder"/host/*.o "$lib"/librung_runtime.a -lpthread -ldl -o "$folder/$name/app"
  for rights in with without; do
    runner=""
    [ $rights = with ] || runner="setpriv --bounding-set=-sys_nice,-ipc_lock --inh-caps=-all"
    (cd "$folder" && $runner "$name/app" --realtime --for 3s $driver --retain "$name.kept" --retain-interval 5ms \
      --control "$commands" --trace "$name.csv" $options > "$name.out" 2>&1) || status=$?
    if grep -q 'WARNING: ThreadSanitizer' "$folder/$name.out" || [ "${status:-0}" != 0 ]; then
      echo "$name, $rights rights: status ${status:-0}"
      head -60 "$folder/$name.out"
      failed=1
    fi
    status=0
  done
  echo "$name: done"
done
exit $failed
