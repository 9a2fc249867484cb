// SPDX-License-Identifier: Apache-2.0
// The variable that starts an event or status task. In: the expression of SINGLE or TRIGGER, once all program instances
// are known. Out: its path in the symbol map, which the host reads. Called by configuration.cpp.
#pragma once

#include <string>

#include "sema/context.h"

namespace rung::sema {

// Forbids a trigger that is not a BOOL variable: a global, a variable of a program instance or of a block in one, or an
// address. Empty after a report. IEC 61131-3 ed. 3, 6.8.2.
//   passes  TASK t(SINGLE := pump.done);  TASK t(SINGLE := %IX2.3);
//   fails   TASK t(SINGLE := 1);                        E0813
std::string triggerPath(Context& context, ExprId trigger, std::string_view task);

}  // namespace rung::sema
