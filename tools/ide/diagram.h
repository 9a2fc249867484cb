// SPDX-License-Identifier: Apache-2.0
// The picture of a body that is drawn: LD, FBD, CFC, SFC, the ladder of NCT. In: the text of a file, which is parsed
// alone, so that a picture never waits for the check of the project, and what the project is known to declare. Out: SVG
// whose groups have ids, where in the text each of them comes from, and the id of what is at a byte. Asked by editors.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/driver/options.h"

namespace rung::ide {

class Scope;  // scope.h

struct DrawnElement {
  std::string id;
  uint32_t begin = 0, end = 0;  // bytes of the file
};

struct DrawnBody {
  std::string pou;    // `Pump.Start`
  std::string title;  // with its language
  std::string svg;
  std::vector<DrawnElement> elements;  // in the order of the text
  std::string cursor;                  // empty: none is there
};

// The innermost body that is drawn and has the byte; without a byte the first one. `known`: tells in-outs of boxes from
// inputs; may be null. None: there is no such body.
std::optional<DrawnBody> drawBodyAt(const driver::ProjectOptions& options, const std::string& path,
                                    const std::string& text, std::optional<uint32_t> byte, const Scope* known);

}  // namespace rung::ide
