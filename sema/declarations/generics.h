// SPDX-License-Identifier: Apache-2.0
// Instances of generic library functions and of blocks with VAR_GENERIC CONSTANT; see generics.cpp.
#pragma once

#include <span>

#include "sema/context.h"

namespace rung::sema {

// A new instance of a generic or extensible library function for these pin types (parsed again from its source).
// `types_by_pin` has one type per declared pin; extra inputs of an extensible pin share that pin's type.
PouId instantiate(Context& context, PouId generic, std::span<const TypeId> types_by_pin, TypeId result);
// The instance of a block with VAR_GENERIC CONSTANT for the values in `Ring<20>`, created on first use; a block without
// them is its own instance. None: reported.
PouId instantiateBlock(Context& context, PouId block, const NamedTypeExpr& written);

}  // namespace rung::sema
