// SPDX-License-Identifier: Apache-2.0
// Assignment attempts: an object as a type that it may have, tested when the program runs. `target ?= source` of
// edition 3, __QUERYINTERFACE and __QUERYPOINTER of CODESYS. In: unchecked operands; see attempts.cpp.
#pragma once

#include "sema/context.h"

namespace rung::sema {

// target ?= source
void checkAttempt(Context& context, AssignStmt& node);

}  // namespace rung::sema
