// SPDX-License-Identifier: Apache-2.0
// {setup}, {teardown} and {skip 'why'} at POUs that they do not fit; see test_pragmas.cpp.
#pragma once

#include "sema/context.h"

namespace rung::sema {

void checkTestPragmas(Context& context);

}  // namespace rung::sema
