// SPDX-License-Identifier: Apache-2.0
// Forbids the address of an expression without memory; see addressable.cpp.
#pragma once

#include "sema/context.h"

namespace rung::sema {

// False after a report.
bool checkAddressable(Context& context, ExprId lvalue);
// The same without a report.
bool hasMemory(const Context& context, ExprId lvalue);

}  // namespace rung::sema
