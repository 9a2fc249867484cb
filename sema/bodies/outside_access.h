// SPDX-License-Identifier: Apache-2.0
// Forbids uses of a block's variables from outside that its sections do not allow; see outside_access.cpp.
#pragma once

#include "sema/access.h"
#include "sema/context.h"

namespace rung::sema {

// Whether a value of the type is an object, whose members have rules of their own.
bool isInstance(const Context& context, TypeId type);
// `node` names the variable `member`, perhaps of a block or program. False after an error.
bool checkOutsideAccess(Context& context, const MemberExpr& node, VarId member, Access access);
// A bare name in a method or accessor that means a variable of the object. False after an error.
bool checkUseInMethod(Context& context, const Var& var, Loc loc);

}  // namespace rung::sema
