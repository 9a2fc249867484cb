// SPDX-License-Identifier: Apache-2.0
// Pointers and references: taking addresses, binding references, and arithmetic on addresses as in CODESYS. In:
// checked or unchecked operands; see pointers.cpp.
#pragma once

#include "sema/access.h"
#include "sema/context.h"

namespace rung::sema {

// Makes an lvalue the target of a reference of this type; reports when the reference cannot be bound to it.
bool bindReference(Context& context, ExprId& lvalue, TypeId reference);
// p[i]: the i-th element after the target of p.
TypeId checkPointerIndex(Context& context, ExprId& expr, Access access);
// p + n, p - n, p - q, and pointers as numbers. None when the types do not combine this way.
TypeId combinePointers(Context& context, ExprId& self, TypeId expected);

}  // namespace rung::sema
