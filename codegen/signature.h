// The signature of a body's function: `float Scale_fn(rung_context* ctx, int16_t raw_)`, without `;`. In: a body. Out:
// C++ code. Called for definitions (body.cpp), prototypes and tables, and by the tool that checks the natives.
#pragma once

#include <string>
#include <string_view>

#include "ir/ir.h"

namespace rung::codegen {

// Native: as the library defines it. `function`: another name; `self`: another type of a native's instance than void.
void appendSignature(std::string& out, const ir::Module& module, const ir::Body& body, std::string_view function = {},
                     std::string_view self = {});

}  // namespace rung::codegen
