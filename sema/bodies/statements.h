// SPDX-License-Identifier: Apache-2.0
// Statements; see statements.cpp.
#pragma once

#include "sema/context.h"

namespace rung::sema {

TypeId checkAssignExpr(Context& context, ExprId expr);
// Checks a list of statements; true when the end of the list can be reached.
bool checkStatements(Context& context, Slice<StmtId> list);
// The operator of a compound assignment such as +=.
BinaryOp binaryOf(AssignOp op);

}  // namespace rung::sema
