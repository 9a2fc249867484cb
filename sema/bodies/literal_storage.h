// SPDX-License-Identifier: Apache-2.0
// Memory for strings whose address is taken: ADR('text') of codesys needs memory for the literal; see
// literal_storage.cpp.
#pragma once

#include "sema/context.h"

namespace rung::sema {

// The list of the strings in a POU whose address is taken; of all POUs without one yet. (bodies/literal_storage.cpp)
void declareLiteralStorage(Context& context, PouId pou);
void declareLiteralStorage(Context& context);
ExprId storageOfLiteral(Context& context, ExprId literal);

}  // namespace rung::sema
