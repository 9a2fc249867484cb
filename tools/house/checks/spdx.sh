#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Each source, header, script and CMake file of the project names its licence, for scanners of those who ship it.
cd "$(dirname "$0")/../../.." || exit 2
missing=$(git ls-files -- '*.cpp' '*.h' '*.c' '*.py' '*.sh' '*.cmake' '*.cmake.in' '*CMakeLists.txt' 'stdlib/*.st' \
  ':!docs' ':!samples' ':!tools/templates' | xargs grep -L 'SPDX-License-Identifier: Apache-2.0')
[ -z "$missing" ] || { echo "without \`SPDX-License-Identifier: Apache-2.0\` at the beginning (a library in ST: at the end):"; echo "$missing"; exit 1; }
