// SPDX-License-Identifier: Apache-2.0
// The tests and mocks that are part of the program. In: the pragmas of all POUs, Options::with_tests and mocks. Out:
// Pou::excluded, Pou::Pragmas::mocks and Scopes::mocks. Called by check() between collecting the declarations and
// resolving them.
#pragma once

#include "sema/context.h"

namespace rung::sema {

void chooseTests(Context& context);

}  // namespace rung::sema
