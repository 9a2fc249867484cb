// SPDX-License-Identifier: Apache-2.0
// An operation of two operands, infix (a = b) or in call form (EQ(a, b)). In: an expression that was checked. Out: its
// operator and both sides. Used by rules that concern both forms.
#pragma once

#include <optional>

#include "sema/context.h"

namespace rung::sema {

struct Operation {
  types::Op op;
  ExprId left, right;
  Loc loc;
  bool is_infix;
};

// None: something else, or an operand was left open.
std::optional<Operation> operationOf(const Context& context, ExprId expr);

}  // namespace rung::sema
