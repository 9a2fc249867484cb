// SPDX-License-Identifier: Apache-2.0
// Class numbers and the dispatch tables of methods. In: the module's classes and dispatches. Out: `classes.cpp`, and
// the declarations by which other files use it. All numbers and tables are defined there and `extern` elsewhere, so a
// new class recompiles that file and its own, no other POU. Every method takes `void* object`: one table type serves
// all classes, and no function is called through a type other than its own. Called by emit.cpp.
//
//   typedef int16_t Motor__Speed_call(void* object, rung_context* ctx);
//   extern Motor__Speed_call* const Motor__Speed_table[];      by class number - Motor__Speed_first
#pragma once

#include <string>
#include <string_view>

#include "codegen/cxx/nodes.h"
#include "ir/ir.h"

namespace rung::codegen {

void declareDispatch(cxx::Tree& tree, const ir::Module& module, ir::BodyId method, cxx::Declarations& to);
std::string classesSource(const ir::Module& module, std::string_view name_space);

}  // namespace rung::codegen
