// SPDX-License-Identifier: Apache-2.0
// The lines of a source and how deep each is indented. In: pieces; the lines stay as the author broke them. Out: a
// level for each line, and what it is. Used by format.cpp.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "frontend/format/format.h"
#include "frontend/format/pieces.h"

namespace rung::format {

enum class LineKind : uint8_t {
  Statement,
  Header,       // of a POU, section or block of declarations
  Declaration,  // of a variable, with a colon
  Remark,       // comments and pragmas alone
  Il,           // an instruction
};

struct Line {
  uint32_t first, last;  // pieces, `last` is one past
  uint32_t level = 0;
  LineKind kind = LineKind::Statement;
  bool continues = false;  // a statement that began above
};

// Also marks the colons of labels and the beginnings of statements in `pieces`.
std::vector<Line> outlineOf(std::string_view source, std::vector<Piece>& pieces, const Bodies& bodies);

}  // namespace rung::format
