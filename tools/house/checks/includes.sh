#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# No file includes a header of a later layer (each layer uses only those before it), the runtime includes no
# compiler code, of the compiler only the interpreter includes the runtime, and nothing includes tests. The registry of
# messages includes the lists of all layers.
set -eu
cd "$(dirname "$0")/../../.."
tools/house/tracked .h .cpp .def | grep -v '^tests/' | xargs -d '\n' grep -Hn '^#include "' | awk '
  # The layers in order; a path belongs to the longest prefix that matches. Equal numbers may not include each other,
  # except in their own folder.
  BEGIN {
    layer["frontend/source/"] = 1
    layer["frontend/syntax/"] = 2
    layer["sema/types/"] = 3
    layer["frontend/parse/"] = 4
    layer["frontend/schedule/"] = 5
    layer["frontend/import/"] = 6
    layer["frontend/export/"] = 7; layer["frontend/render/"] = 7
    layer["sema/"] = 8
    layer["sema/declarations/"] = 8.1; layer["sema/bodies/"] = 8.2; layer["sema/checks/"] = 8.3; layer["sema/check."] = 8.4
    layer["ir/"] = 9
    layer["codegen/"] = 10
    layer["tools/driver/"] = 10.5
    layer["tools/workspace/"] = 11
    layer["tools/protocol/"] = 11.1; layer["tools/ide/"] = 11.1; layer["tools/debug/"] = 11.1; layer["tools/lsp/"] = 11.2; layer["tools/dap/"] = 11.3; layer["tools/monitor/"] = 11.2
    layer["tools/"] = 12
    layer["stdlib/"] = -1; layer["cam/"] = -2
  }
  function prefix(path,   p, best) {
    best = ""
    for (p in layer) if (index(path, p) == 1 && length(p) > length(best)) best = p
    return best
  }
  {
    split($0, part, ":"); file = part[1]; line = part[2]
    header = $0; sub(/^[^"]*"/, "", header); sub(/".*$/, "", header)
    from = prefix(file); to = prefix(header)
    if (header ~ /^rung\//) to = "stdlib/"                 # the public headers of the runtime
    if (header ~ /^frontend\/import\/nct\/nc_(symbols|scopes)\.def$/) next  # tables of the compiler and the simulated control
    if (header ~ /^tests\//) { print file ":" line ": includes a test, " header; bad = 1; next }
    if (from == "" || to == "" || from == to) next
    if (layer[from] < 0 && layer[to] > 0) { print file ":" line ": the runtime includes compiler code, " header; bad = 1 }
    if (layer[from] > 0 && layer[to] < 0 && layer[from] < layer["tools/driver/"] && header != "rung/module.h" && to == "stdlib/" && file !~ /^ir\/interpreter\//) {
      print file ":" line ": the compiler includes the runtime, " header; bad = 1
    }
    if (file == "frontend/source/registry.cpp" && header ~ /(diagnostics|rules)\.def$/) next  # rows of all layers, no code
    if (layer[from] > 0 && layer[to] >= layer[from]) {
      print file ":" line ": " from " may not use " to ", a layer that is not before it: " header; bad = 1
    }
  }
  END { exit bad }'
