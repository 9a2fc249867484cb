// SPDX-License-Identifier: Apache-2.0
// Prints C++ that is a value (nodes.h). This alone knows when an operand needs parentheses, how braces close and how
// lines go: the lines of the code follow those of the source, and `#line` appears only where they diverge, which keeps
// the code small. Called by all that writes a file of C++.
#pragma once

#include <string>

#include "codegen/cxx/nodes.h"

namespace rung::codegen::cxx {

void print(std::string& out, Ex expression);
std::string toString(Ex expression);
// The statements of a function, after its opening brace or declarations.
void print(std::string& out, const Tree& tree, const Statements& body);
// Declarations, each on its own lines.
void print(std::string& out, const Tree& tree, const Declarations& declarations);
// One declaration without the end of its line.
void print(std::string& out, const Tree& tree, const Decl& decl);
// A function without its statements and without `;`.
void printSignature(std::string& out, const Function& function);
// `float (*x)[3]`
void print(std::string& out, const Type& type, std::string_view name);
std::string toString(const Type& type, std::string_view name);

}  // namespace rung::codegen::cxx
