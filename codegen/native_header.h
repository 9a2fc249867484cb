// SPDX-License-Identifier: Apache-2.0
// The header for native blocks: what a C++ file that defines their bodies includes. In: a module and native bodies of
// one library in it. Out: for each body its prototype, and the structs and enumerations that it works on, as C++. The
// layout is asserted beside each struct, so a compiler that would lay it out differently refuses the file. Called by
// emit.cpp for the blocks of a project, and by the tool native_table for those of Rung's libraries.
//
//   namespace plant { struct Filter_type { float x_; float y_; }; }
//   extern "C" void rung_plant_Filter(rung_context* ctx, plant::Filter_type* self);
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "ir/ir.h"

namespace rung::codegen {

// Without `#pragma once` and includes.
std::string nativeDeclarations(const ir::Module& module, std::span<const ir::BodyId> bodies,
                               std::string_view name_space);

// With them: a whole file.
std::string nativeHeader(std::string_view declarations);

}  // namespace rung::codegen
