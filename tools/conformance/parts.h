// SPDX-License-Identifier: Apache-2.0
// Leaving out what is wrong in a source, so that an error stands alone. In: a text and the line of an error that has to
// go. Out: the parts that can be blanked, and the text without them. Called by export.cpp for cases of kind reject.
#pragma once

#include <string>
#include <vector>

#include "frontend/source/dialect.h"

namespace rung::conformance {

// The exporter gives each body this, so that it is one when its statements are gone.
constexpr const char* kIdleDeclaration = "VAR suite_idle : BOOL; END_VAR ";
constexpr const char* kIdleStatement = "suite_idle := TRUE;";

// A byte range that can be left out: a statement, a declaration, a line.
struct Part {
  size_t begin, end;
  bool nested = false;  // a statement in a statement: its list needs one
};

// The parts that contain the line, from the innermost to the outermost.
std::vector<Part> partsAround(const std::string& text, Dialect dialect, uint32_t line);

// The text with the part blanked; lines stay where they are.
void blank(std::string& text, const Part& part);

// TYPE … END_TYPE and VAR … END_VAR of which nothing is left go, too.
void blankEmptySections(std::string& text);

}  // namespace rung::conformance
