// The file of a POU whose body is in C++ (design §8): its text between a facade of its variables and the function that
// other generated code calls. In: a row of Module::cpp_bodies. Out: a Group with that file's text, and the lines that
// stand in front of it. Called by emit.cpp, one file for each body.
#pragma once

#include <string>

#include "codegen/facts.h"
#include "codegen/group.h"

namespace rung::codegen {

struct CppFile {
  Group group;
  std::string front;  // the body's own #include lines come before everything
};
CppFile writeCppBody(const ir::Module& module, const Facts& facts, const ir::CppBody& cpp);

}  // namespace rung::codegen
