#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# A header of sema/ is the interface of the .cpp beside it: it declares only functions that this file defines, so that a
# lower layer cannot call a later one through a declaration of its own. pseudo_functions.h lists the functions of a table.
exec python3 - "$(dirname "$0")/../../.." <<'PYTHON'
import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1]).resolve()
bad = 0
for header in sorted([*root.glob("sema/*.h"), *(h for h in root.glob("sema/*/*.h") if h.parent.name != "types")]):
    if header.name == "pseudo_functions.h":
        continue
    source = header.with_suffix(".cpp")
    text = source.read_text() if source.exists() else ""
    for number, line in enumerate(header.read_text().splitlines(), 1):
        declared = re.match(r"(?!using |inline |constexpr |static |return )[A-Za-z_][\w:<>*&, ]*?\b(\w+)\([^{]*$", line)
        if declared and not re.search(rf"^[A-Za-z_][\w:<>*&, ]*\b{declared[1]}\(", text, re.MULTILINE):
            print(f"{header.relative_to(root)}:{number}: `{declared[1]}` is not defined in the .cpp beside this header")
            bad = 1
sys.exit(bad)
PYTHON
