// SPDX-License-Identifier: Apache-2.0
// Overload resolution: which of several functions or methods of one name a call means; see overloads.cpp.
#pragma once

#include "sema/context.h"

namespace rung::sema {

// The function or method of one name that a call means; none after a report. `checked`: its arguments are checked,
// except literals.
bool isOverloaded(const Context& context, PouId called);
PouId chooseOverload(Context& context, const CallExpr& node, PouId called, bool& checked);

}  // namespace rung::sema
