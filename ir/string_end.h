// SPDX-License-Identifier: Apache-2.0
// Strings that other variables may overlap: in a UNION, in a memory area, through a pointer. What is written there can
// take the final zero away, so a string read from there is at most as long as its type, whatever follows it. Called by
// lowering, which reads such a string through a temporary, and by codegen.
#pragma once

#include "ir/ir.h"

namespace rung::ir {

bool mayLackEnd(const types::TypeTable& types, const Body& body, ExprId place);

}  // namespace rung::ir
