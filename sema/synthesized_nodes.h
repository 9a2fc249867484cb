// SPDX-License-Identifier: Apache-2.0
// Nodes that sema adds to code, complete with their types: known values become literals, implicit operations
// expressions. In: operands that were checked. Out: a node that need not be checked again.
#pragma once

#include <string_view>

#include "sema/context.h"

namespace rung::sema {

// Gives a new node its type.
ExprId typed(Context& context, ExprId created, TypeId type);
// A literal of a known type.
ExprId makeLiteral(Context& context, LiteralKind kind, TypeId type, int64_t value, Loc loc);
// A string of the type STRING(its length).
ExprId makeStringLiteral(Context& context, std::string_view text, Loc loc);
// The name of something that is known, and of a member.
ExprId makeName(Context& context, NameId name, Entity entity, Loc loc);
ExprId makeMember(Context& context, ExprId base, NameId name, Entity entity, Loc loc);
ExprId makeBinary(Context& context, BinaryOp op, ExprId left, ExprId right, TypeId type, Loc loc);
ExprId makeDeref(Context& context, ExprId pointer, TypeId target, Loc loc);
ExprId makeAddressOf(Context& context, ExprId lvalue, TypeId type, Loc loc);
// An integer of either sign.
ExprId makeInteger(Context& context, TypeId type, __int128 value, Loc loc);

}  // namespace rung::sema
