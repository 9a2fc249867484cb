// SPDX-License-Identifier: Apache-2.0
// Functions and methods of one name: see overloads.cpp. Called where declarations are collected and checked.
#pragma once

#include "sema/context.h"

namespace rung::sema {

// Adds a declaration under a name that is in use; false: it is declared twice.
bool addOverload(Context& context, Entity first, PouId added);
// A method alone in its class that overrides one of several in a base is an overload, too. Called when all members are
// declared.
void markOverloads(Context& context);
void checkOverloads(Context& context, PouId head);

}  // namespace rung::sema
