// Forbids uses of a block's variables from outside that its sections do not allow; see outside_access.cpp.
#pragma once

#include "sema/bodies/bodies.h"

namespace rung::sema {

// `member` is a variable of the block or program whose instance `record` is. False after an error.
bool checkOutsideAccess(Context& context, const MemberExpr& node, VarId member, TypeId record, Access access);

}  // namespace rung::sema
