// SPDX-License-Identifier: Apache-2.0
// The signature of a body's function: `float Scale_fn(rung_context* ctx, int16_t raw_)`. In: a body. Out: a function of
// C++ without its statements (cxx/nodes.h). Called for definitions (body.cpp), prototypes and tables, and by the tool
// that checks the natives.
#pragma once

#include <string>
#include <string_view>

#include "codegen/cxx/nodes.h"
#include "ir/ir.h"

namespace rung::codegen {

// Native: as the library defines it. `function`: another name; `self`: another type of a native's instance than void.
cxx::Function* signatureOf(cxx::Tree& tree, const ir::Module& module, const ir::Body& body,
                           std::string_view function = {}, std::string_view self = {});
// The same as text, without `;`.
void appendSignature(std::string& out, const ir::Module& module, const ir::Body& body);

// The length of a string goes with it: a STRING that a function of the project takes as in-out is followed by the
// address of its length, or of RUNG_UNCOUNTED. The function leaves there the length that the string has at its end.
// Methods are called through tables, and C++ bodies take strings only: those count for themselves.
bool passesLength(const ir::Module& module, const ir::Body& function, const ir::Local& parameter);

}  // namespace rung::codegen
