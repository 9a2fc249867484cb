// SPDX-License-Identifier: Apache-2.0
// Pieces of source for people: a declaration on one line, the documentation of a declaration.
#pragma once

#include <string>
#include <string_view>

#include "frontend/syntax/tree.h"

namespace rung::ide {

// The parsed source of a range, with each run of blanks and line ends as one blank, and without comments.
std::string sourceOnOneLine(const Sources& sources, Range range);

// The documentation of a declaration as Markdown: its `///` lines, before it or after it on its line, else the comment
// directly above it. Empty: it has none.
std::string documentationOf(const Sources& sources, const DeclHeader& declaration);
std::string documentationAbove(std::string_view source, size_t declaration);

}  // namespace rung::ide
