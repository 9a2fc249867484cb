// SPDX-License-Identifier: Apache-2.0
// Prints C++ that is a value (nodes.h). This alone knows when an operand needs parentheses, and how lines go: the lines
// of the code follow those of the source, and `#line` appears only where they diverge, which keeps the code small.
// Called by body.cpp for each function.
#pragma once

#include <string>

#include "codegen/cxx/nodes.h"

namespace rung::codegen::cxx {

void print(std::string& out, Ex expression);
std::string toString(Ex expression);
// The statements of a function, after its opening brace or declarations.
void print(std::string& out, const Tree& tree, const Statements& body);

}  // namespace rung::codegen::cxx
