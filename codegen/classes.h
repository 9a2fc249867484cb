// The numbers of classes and the tables by which methods are found (design §6). In: the module's classes and
// dispatches. Out: the text of `classes.cpp`, the only file that a new class changes beside its own, and the
// declarations by which other files use it. Called by emit.cpp.
//
//   typedef int16_t Motor__Speed_call(void* object, rung_context* ctx);
//   extern Motor__Speed_call* const Motor__Speed_table[];      by class number - Motor__Speed_first
#pragma once

#include <string>
#include <string_view>

#include "ir/ir.h"

namespace rung::codegen {

std::string declareDispatch(const ir::Module& module, ir::BodyId method);
std::string classesSource(const ir::Module& module, std::string_view name_space);

}  // namespace rung::codegen
