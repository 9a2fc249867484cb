// SPDX-License-Identifier: Apache-2.0
// Mocks: {replaces 'X'} before a function or block, {mock 'M'} before a test; see mocks.cpp.
#pragma once

#include "sema/context.h"

namespace rung::sema {

// Selects the tests and mocks that are part of the program. Between collecting the declarations and resolving them.
void chooseTests(Context& context);
// Before the bodies: library blocks that mocks replace join the project.
void checkMocks(Context& context);

}  // namespace rung::sema
