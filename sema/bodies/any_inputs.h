// SPDX-License-Identifier: Apache-2.0
// Inputs of type ANY, ANY_NUM … of a POU in codesys: the caller passes the address, the length and the type class of
// its variable (__SYSTEM.AnyType); see any_inputs.cpp.
#pragma once

#include "sema/context.h"

namespace rung::sema {

// The item of __SYSTEM.TYPE_CLASS for a type.
uint32_t typeClassOf(const Context& context, TypeId type);
// The value of an input of type ANY, ANY_NUM …, of a POU in codesys.
void bindAny(Context& context, const Pou& pou, const Var& pin, ExprId& value);

}  // namespace rung::sema
