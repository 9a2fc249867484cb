// SPDX-License-Identifier: Apache-2.0
// The file of a POU whose body is in C++: the source of the body between a facade of its variables and the function
// that other generated code calls. In: a row of Module::cpp_bodies. Out: a Group with the code of that file, and the
// lines at its beginning. Called by emit.cpp, one file for each body: such bodies never share a file in a batch.
#pragma once

#include <string>

#include "codegen/facts.h"
#include "codegen/group.h"

namespace rung::codegen {

struct CppFile {
  Group group;
  std::string front;  // the body's own #include lines come first
};
CppFile writeCppBody(const ir::Module& module, const EmitOptions& options, const Facts& facts, const ir::CppBody& cpp);

}  // namespace rung::codegen
