// SPDX-License-Identifier: Apache-2.0
// __NEW and __DELETE: memory from the bounded pool of the program (stdlib/__system/dynamic_memory.st). codesys; see
// dynamic_memory.cpp.
#pragma once

#include "sema/context.h"

namespace rung::sema {

TypeId checkNew(Context& context, ExprId& expr);

}  // namespace rung::sema
