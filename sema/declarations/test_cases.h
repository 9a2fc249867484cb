// SPDX-License-Identifier: Apache-2.0
// {case input := value, …} before a test: the test runs once for each case, with these inputs. In: the pragmas of all
// POUs. Out: Pou::Pragmas::cases, with checked values. Called by check(), when all POUs are resolved.
#pragma once

#include "sema/context.h"

namespace rung::sema {

void resolveTestCases(Context& context);

}  // namespace rung::sema
