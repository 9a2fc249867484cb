// What FOR asks of its control variable, limits and step; see for_header.cpp.
#pragma once

#include "sema/bodies/bodies.h"

namespace rung::sema {

// The type of the control variable, or Error.
TypeId checkForControl(Context& context, ForStmt& node);
// From, to and step have the control variable's type.
void checkForBounds(Context& context, const ForStmt& node);

}  // namespace rung::sema
